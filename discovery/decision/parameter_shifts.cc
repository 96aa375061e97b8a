#include "discovery/decision/parameter_shifts.h"

#include <fmt/format.h>

#include <cmath>

namespace ambrig {

std::vector<std::string> ParameterShifts(const Hypothesis& h, double least, double looser) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < h.free.size(); ++k) {
    const double sds = looser * h.Coordinate(k);
    if (std::abs(sds) > least && h.free[k].effect < 0)
      out.push_back(fmt::format("{} {:+.2f} sd", h.free[k].path, sds));
  }
  return out;
}

}  // namespace ambrig
