#include "cantilever.h"

#include "cantilever_csv.h"
#include <algorithm>
#include <sstream>

namespace StepNMM2
{
  std::string
  name(const Load load)
  {
    return load == Load::dead ? "dead" : "follower";
  }


  double
  Parameters::force() const
  {
    const double section = std::pow(height, 3) / 12.;
    return last_load * youngs_modulus * section / std::pow(length, 3);
  }


  std::vector<Tutorial::Record>
  reference(const Load load)
  {
    std::istringstream            csv(cantilever_csv);
    std::vector<Tutorial::Record> records;
    for (const Tutorial::Record &record : Tutorial::read_csv(csv))
      if (record.at("load") == name(load))
        records.push_back(record);
    return records;
  }


  double
  largest_error(const Load load, const std::map<double, double> &deflections)
  {
    double largest = 0.;
    for (const Tutorial::Record &record : reference(load))
      for (const auto &[K, w] : deflections)
      {
        const std::string &solid = record.at("solid_w_over_L");
        if (std::abs(K - std::stod(record.at("K"))) < 1e-9 && !solid.empty())
          largest = std::max(largest, std::abs(w / std::stod(solid) - 1.));
      }
    return largest;
  }
} // namespace StepNMM2
