#include "faulttolerance/supervision/current_transition_policy.h"

#include "core/base/errors.h"
#include "core/math/constants.h"

namespace ambrig {

CoilForm InductanceOf(const TransitionStart& s) {
  const RedistributionProblem& b = s.bearing;
  const CoilVector m = b.turns * b.turns_left.cwiseProduct(b.sign);
  const double P = kMu0 * b.pole_area / b.gap;
  CoilForm L = P * (CoilForm(m.cwiseAbs2().asDiagonal()) - m * m.transpose() / 8);
  for (int j = 0; j < 8; ++j)
    L(j, j) += b.turns_left[j] > 0 ? s.leakage * b.turns_left[j] * b.turns_left[j] : 1.0;
  return L;
}

CoilVector RampStep(const TransitionStart& s) {
  return s.voltage * s.period * InductanceOf(s).diagonal().cwiseInverse();
}

std::unique_ptr<CurrentTransition> MakeCurrentTransition(const std::string& name,
                                                         const TransitionStart& start) {
  if (name == "jump") return MakeJump();
  if (name == "ramp") return MakeRamp(start);
  if (name == "bias-first") return MakeBiasFirst(start);
  if (name == "force-preserving") return MakeForcePreserving(start);
  if (name == "time-optimal") return MakeTimeOptimal(start);
  Require(false, "a current transition policy");
  return nullptr;
}

}  // namespace ambrig
