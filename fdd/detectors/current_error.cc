#include "fdd/detectors/current_error.h"

#include <algorithm>

#include "fdd/detectors/slope_statistic.h"

namespace ambrig {

CurrentErrorDetector::CurrentErrorDetector(const CoilDetectorSetup& setup)
    : sampling_(setup.settings.sampling), coils_(setup.model.coils) {
  const AmplifierParameters& a = *sampling_.amplifier;
  const double T = 1 / a.switching_frequency;
  const Lane P = setup.model.Permeance(0, 0);
  for (int j = 0; j < coils_; ++j) {
    const double L = InPhaseInductance(setup.model, j, P);
    lag_[j] = std::min(1.0, T * a.kp / L);
    slew_[j] = T * a.bus_voltage / L;
  }
}

Lane CurrentErrorDetector::Period(const MeasuredPeriod& in) {
  Lane out;
  if (!in.set_point) return out;
  Lane& error = error_[count_ % kPeriods];
  for (int j = 0; j < coils_; ++j) {
    double mean = 0;
    for (int k = 0; k < sampling_.samples; ++k) mean += in.adc[k][j];
    mean /= sampling_.samples;
    const double set = (*in.set_point)[j];
    double& p = follower_[j];
    if (count_ == 0) p = mean;
    p += std::clamp((set - p) * lag_[j], -slew_[j], slew_[j]);
    error[j] = std::max({0.0, std::min(set, p) - mean, mean - std::max(set, p)});
  }
  ++count_;
  if (count_ < kPeriods) return out;
  out = error_[0];
  for (const Lane& e : error_)
    for (int j = 0; j < coils_; ++j) out[j] = std::min(out[j], e[j]);
  return out;
}

CoilDetectorKind CurrentError() {
  return {"current-error", "A",   "mean current against its set-point, five periods in a row",
          kRequired,       0.178, MakeDetector<CurrentErrorDetector>};
}

}  // namespace ambrig
