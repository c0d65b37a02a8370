#pragma once

#include "report/MethodRun.h"

#include <optional>
#include <string>
#include <vector>

/// \file RunStore.h
/// Runs that are done, in a folder: each a .json file and its pictures.

namespace vantage
{

/// What a run has given so far.
struct RunRecord
{
  std::string identity; ///< of target, plan and program; a record with another one is not its own
  bool isFinished = false;
  std::vector<Measurement> measurements;
  std::string interactionImage; ///< name of a file; empty when there is none
  std::string interactionCaption;
};

/// Where the record of a run and its pictures are. All names of files in a record are relative to
/// the folder.
class RunStore
{
public:
  /// The folder is made when it is missing. \throw InputError
  RunStore(std::string folder, std::string targetIdentity);

  /// A record for that run, empty but for what tells whose it is.
  RunRecord NewRecord(const RunPlan& plan) const;
  /// What is stored of it; nothing when there is nothing, or it is of another scene, view, budget
  /// or program, or damaged.
  std::optional<RunRecord> Find(const RunPlan& plan) const;
  /// Whole or not at all. \throw InputError
  void Save(const RunPlan& plan, const RunRecord& record) const;

  /// The name of a picture of that run, such as "basic-shooting-0123456789abcdef-3.png".
  std::string PictureName(const RunPlan& plan, const std::string& which) const;
  std::string PathOf(const std::string& name) const;

private:
  std::string IdentityOf(const RunPlan& plan) const;
  std::string StemOf(const RunPlan& plan) const;

  std::string Folder;
  std::string TargetIdentity;
};

} // namespace vantage
