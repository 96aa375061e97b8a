#pragma once
/// The independent model of contact: the rotor of a RotorModel as rigid bodies of the Open Dynamics
/// Engine. Same parameters, forces and effects; another solver of motion and contact:
///
///   - the rotor turns in full: finite rotations in all six degrees of freedom, spin included (the
///     speed profile by a motor on the spin axis, a free speed by friction), no small angles;
///   - races on mounts and turning races are bodies of their own, the base is one, all of them in
///     the frame of the floor: what is relative in RotorModel is a difference here;
///   - friction is Coulomb's with sticking, |F| <= mu N, solved with the normal force as one
///     complementarity problem a step (RotorModel: mu N v/√(v² + v_s²)). Across the direction of
///     turning there is none, as in RotorModel;
///   - contact geometry is computed here (journal circle in race circle, axial stops) and handed
///     over as contact joints. The force law goes over as their two numbers:
///       v_n⁺ + CFM N = ERP p/h  with  CFM = 1/b, ERP = h F/(b p), F = k pⁿ, b = F damping
///       is  N = F - b v_n⁺ = k pⁿ (1 + damping p'), N >= 0.
///     (ODE's manual takes b + h k for b, the implicit Euler rule: it would lose a share
///     π ω h/2 of the rebound speed, ω² = k/m, whatever the damping. Not needed where ω h << 1.)
///
/// ODE's step is semi-implicit Euler (order one, symplectic). Its gyroscopic term is not used: it
/// is of order one in Omega h. Instead each step goes over the angular momentum L:
///   half a step of the axis under L, ODE's step with that ω, L from its ω⁺, ω from L and the new
///   axis,
/// of order two, and exact in L. Source: docs/theory/contact.md; docs/theory/base_model.md 1, 8.
#include <memory>

#include "rotor/motion/rotor_model.h"
#include "rotor/motion/rotor_stepper.h"

namespace ambrig {

struct OdeOptions {
  double step = 1e-6;               // [s] longest; shorter where a contact or a mount needs it
  double far_step = 5e-6;           // [s] longest when nothing is near a contact
  bool native_gyroscopics = false;  // ODE's own gyroscopic term (to measure what it is worth)
};

class OdeRotor : public RotorStepper {
 public:
  /// `model` must outlive this. @throws InputError for what a rigid rotor cannot show (bending
  /// modes) and for a rotor without polar inertia.
  explicit OdeRotor(const RotorModel& model, const OdeOptions& options = {});
  ~OdeRotor() override;
  void Step(MotionState& s, const DofVector& Q, double stator_x, double stator_y,
            double dt) override;
  long steps() const;     // of ODE so far
  long warnings() const;  // of ODE's solver so far

 private:
  class Rig;
  std::unique_ptr<Rig> rig_;
};

}  // namespace ambrig
