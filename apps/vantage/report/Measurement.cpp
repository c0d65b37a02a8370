#include "report/Measurement.h"

#include "io/TextLines.h"

namespace vantage
{

std::string PrintMeasurements(const std::vector<Measurement>& measurements)
{
  std::string csv = "method,picture,powerTolerance,budget,cutShort,steps,elements,interactions,"
                    "evaluations,rays,error,rmse,bias,errorEstimate,solveCpuSeconds,"
                    "imageCpuSeconds,cpuSeconds\n";
  for (const Measurement& m : measurements)
  {
    csv += m.method + ',' + m.picture + ',' +
           (m.powerTolerance > 0.0 ? PrintNumber(m.powerTolerance) : "") + ',' +
           PrintNumber(m.budget) + ',' + (m.isCutShort ? "yes" : "no") + ',' +
           std::to_string(m.steps) + ',' + std::to_string(m.elements) + ',' +
           std::to_string(m.interactions) + ',' + std::to_string(m.evaluations) + ',' +
           std::to_string(m.rays);
    for (const double number : { m.error, m.rmse, m.bias, m.errorEstimate, m.solveCpuSeconds,
           m.imageCpuSeconds, m.CpuSeconds() })
    {
      csv += ',' + PrintNumber(number);
    }
    csv += '\n';
  }
  return csv;
}

} // namespace vantage
