#pragma once
/// A spring and damper between a rig's rotor and its stator (rotor/shaft/support.h), as
/// the engines and the linear model take it.
#include "rotor/linear/force_term.h"
#include "rotor/shaft/support.h"

namespace ambrig {

class SupportTerm : public ForceTerm {
 public:
  /// To ground, without added masses.
  SupportTerm(const PlaneMap& plane, const SpringSupport& support);
  void Add(const MotionState& state, RotorForces& forces) const override;

 private:
  PlaneMap plane_;
  SpringSupport support_;
};

}  // namespace ambrig
