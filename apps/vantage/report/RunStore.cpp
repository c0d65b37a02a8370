#include "report/RunStore.h"

#include "CommandLine.h"
#include "io/AtomicFile.h"
#include "report/Provenance.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace vantage
{

namespace
{

using Json = nlohmann::ordered_json;

Json ToJson(const Measurement& m)
{
  return { { "method", m.method }, { "picture", m.picture }, { "powerTolerance", m.powerTolerance },
    { "budget", m.budget }, { "cutShort", m.isCutShort }, { "steps", m.steps },
    { "elements", m.elements }, { "interactions", m.interactions },
    { "evaluations", m.evaluations }, { "rays", m.rays }, { "error", m.error }, { "rmse", m.rmse },
    { "bias", m.bias }, { "errorEstimate", m.errorEstimate },
    { "solveCpuSeconds", m.solveCpuSeconds }, { "imageCpuSeconds", m.imageCpuSeconds },
    { "image", m.image }, { "differenceImage", m.differenceImage } };
}

/// Numbers that are not finite are null in JSON.
double NumberOf(const Json& json)
{
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Measurement MeasurementOf(const Json& json)
{
  Measurement m;
  m.method = json.at("method");
  m.picture = json.at("picture");
  m.powerTolerance = NumberOf(json.at("powerTolerance"));
  m.budget = NumberOf(json.at("budget"));
  m.isCutShort = json.at("cutShort");
  m.steps = json.at("steps");
  m.elements = json.at("elements");
  m.interactions = json.at("interactions");
  m.evaluations = json.at("evaluations");
  m.rays = json.at("rays");
  m.error = NumberOf(json.at("error"));
  m.rmse = NumberOf(json.at("rmse"));
  m.bias = NumberOf(json.at("bias"));
  m.errorEstimate = NumberOf(json.at("errorEstimate"));
  m.solveCpuSeconds = NumberOf(json.at("solveCpuSeconds"));
  m.imageCpuSeconds = NumberOf(json.at("imageCpuSeconds"));
  m.image = json.at("image");
  m.differenceImage = json.at("differenceImage");
  return m;
}

RunRecord RecordOf(const Json& json)
{
  RunRecord record;
  record.identity = json.at("identity");
  record.isFinished = json.at("finished");
  record.interactionImage = json.at("interactionImage");
  record.interactionCaption = json.at("interactionCaption");
  for (const Json& measurement : json.at("measurements"))
  {
    record.measurements.push_back(MeasurementOf(measurement));
  }
  return record;
}

} // namespace

RunStore::RunStore(std::string folder, std::string targetIdentity)
  : Folder(std::move(folder))
  , TargetIdentity(std::move(targetIdentity))
{
  PrepareFolder(this->Folder);
}

std::string RunStore::IdentityOf(const RunPlan& plan) const
{
  return plan.Identity() + "; " + this->TargetIdentity;
}

std::string RunStore::StemOf(const RunPlan& plan) const
{
  return plan.method + '-' + HashOfText(this->IdentityOf(plan));
}

std::string RunStore::PictureName(const RunPlan& plan, const std::string& which) const
{
  return this->StemOf(plan) + '-' + which + ".png";
}

std::string RunStore::PathOf(const std::string& name) const
{
  return (std::filesystem::path(this->Folder) / name).string();
}

RunRecord RunStore::NewRecord(const RunPlan& plan) const
{
  RunRecord record;
  record.identity = this->IdentityOf(plan);
  return record;
}

std::optional<RunRecord> RunStore::Find(const RunPlan& plan) const
{
  std::ifstream file(this->PathOf(this->StemOf(plan) + ".json"));
  const Json json = Json::parse(file, nullptr, false);
  if (json.is_discarded())
  {
    return std::nullopt;
  }
  try
  {
    const RunRecord record = RecordOf(json);
    const auto isThere = [&](const std::string& name)
    { return name.empty() || std::filesystem::exists(this->PathOf(name)); };
    bool isWhole = record.identity == this->IdentityOf(plan) && isThere(record.interactionImage);
    for (const Measurement& m : record.measurements)
    {
      isWhole = isWhole && isThere(m.image) && isThere(m.differenceImage);
    }
    return isWhole ? std::optional(record) : std::nullopt;
  }
  catch (const Json::exception&)
  {
    return std::nullopt;
  }
}

void RunStore::Save(const RunPlan& plan, const RunRecord& record) const
{
  Json measurements = Json::array();
  for (const Measurement& m : record.measurements)
  {
    measurements.push_back(ToJson(m));
  }
  const Json json = { { "identity", record.identity }, { "finished", record.isFinished },
    { "interactionImage", record.interactionImage },
    { "interactionCaption", record.interactionCaption }, { "measurements", measurements } };
  WriteTextAtomically(this->PathOf(this->StemOf(plan) + ".json"), json.dump(2) + "\n");
}

} // namespace vantage
