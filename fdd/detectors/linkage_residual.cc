#include "fdd/detectors/linkage_residual.h"

#include <algorithm>

#include "fdd/measurement/motion_uncertainty.h"

namespace ambrig {

LinkageResidual::LinkageResidual(const CoilDetectorSetup& setup)
    : model_(setup.model), s_(setup.settings) {
  tolerance_.uncertainty[0] = s_.leakage_sd * s_.leakage_sd;
  tolerance_.uncertainty[2] = s_.gap_sd * s_.gap_sd;
  for (int j = 0; j < model_.coils; ++j) watched_[j] = 1;
  const Lane P = model_.Permeance(0, 0);
  centred_ = *std::max_element(P.v, P.v + kLanes);
}

bool LinkageResidual::Compute(const MeasuredPeriod& in) {
  ComputePeriodSlopes(model_, s_.sampling, in, &slopes_);
  Lane uncertainty[2];
  if (in.uncertainty.any()) ResidualUncertainty(model_, slopes_, in.uncertainty, uncertainty);
  chart_.Compute(model_, s_.sampling, s_, tolerance_, slopes_, watched_,
                 in.uncertainty.any() ? uncertainty : nullptr, 0);
  return in.comparable && slopes_.permeance.largest * kClosestGap < centred_;
}

}  // namespace ambrig
