#include "core/math/line_weights.h"

namespace ambrig {

std::vector<double> LineWeights(const std::vector<double>& places, double z) {
  double n = 0, s = 0, ss = 0;
  for (double zk : places) {
    n += 1;
    s += zk;
    ss += zk * zk;
  }
  const double det = n * ss - s * s;
  std::vector<double> w;
  for (double zk : places)
    w.push_back(det > 1e-12 * (ss + 1e-12) ? (ss - s * zk + z * (n * zk - s)) / det : 1 / n);
  return w;
}

}  // namespace ambrig
