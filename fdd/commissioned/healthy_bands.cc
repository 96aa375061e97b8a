#include "fdd/commissioned/healthy_bands.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {
constexpr std::size_t kSettle = 200;  // periods before anything counts
}

void AddHealthyBands(const CoilDetectorSetup& setup, const CommissioningLog& log,
                     CommissionedBearing* bearing) {
  CommissionedBearing open = *bearing;  // without a range: every period counts
  for (double& v : open.largest_flux.v) v = kInfinity;
  CommissionedDetector detector(setup, open);
  detector.IgnoreDrift();
  for (std::size_t n = 0; n < log.size(); ++n) {
    detector.Watch(log.At(n));
    if (n < kSettle) continue;
    const FluxPeriod& p = detector.period();
    for (int j = 0; j < setup.model.coils; ++j) {
      bearing->largest_flux[j] = std::max(bearing->largest_flux[j], p.largest_flux[j]);
      bearing->current_error[j] = std::max(bearing->current_error[j], detector.current_error()[j]);
    }
    for (int w = 0; w < kExcessWindows; ++w) {
      const Lane c = detector.Excess(w);
      for (int j = 0; j < setup.model.coils; ++j)
        bearing->largest[w][j] = std::max(bearing->largest[w][j], std::abs(c[j]));
    }
    bearing->pattern = std::max(bearing->pattern, detector.windows().Pattern(2));
  }
}

}  // namespace ambrig
