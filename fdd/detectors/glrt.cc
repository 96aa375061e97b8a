#include "fdd/detectors/glrt.h"

#include <algorithm>

namespace ambrig {

double Glrt::Add(const double* r) {
  const std::size_t size = ring_.size();
  std::copy(r, r + channels_, ring_[next_].r);
  double sum[kMostChannels] = {};
  held_ = std::min(held_ + 1, size);
  g_ = 0;
  std::size_t at = next_;
  for (std::size_t m = 1; m <= held_; ++m) {
    double square = 0;
    for (int c = 0; c < channels_; ++c) {
      sum[c] += ring_[at].r[c];
      square += sum[c] * sum[c];
    }
    g_ = std::max(g_, square / (2 * static_cast<double>(m)));
    at = at == 0 ? size - 1 : at - 1;
  }
  next_ = (next_ + 1) % size;
  return g_;
}

Lane GlrtDetector::Period(const MeasuredPeriod& in) {
  const bool comparable = residual_.Compute(in);
  Lane out;
  for (int j = 0; j < kLanes; ++j) {
    const bool valid = residual_.valid(0, j) || residual_.valid(1, j);
    Glrt& chart = chart_[static_cast<std::size_t>(j)];
    const double r[2] = {residual_.z(0, j), residual_.z(1, j)};  // 0 where not valid
    out[j] = comparable && valid ? chart.Add(r) : chart.statistic();
  }
  return out;
}

CoilDetectorKind GlrtOfResiduals() {
  return {"glrt",    "-", "likelihood ratio on the coupled residuals, unknown change",
          kRequired, 124, MakeDetector<GlrtDetector>};
}

}  // namespace ambrig
