#include "discovery/data/bench_tables.h"

#include <cmath>

#include "core/base/parameters.h"

namespace ambrig {

double CoherenceSd(double magnitude, double g2, double averages) {
  if (!(g2 > 0)) return kInfinity;
  return g2 < 1 ? magnitude * std::sqrt((1 - g2) / (2 * averages * g2)) : 0;
}

}  // namespace ambrig
