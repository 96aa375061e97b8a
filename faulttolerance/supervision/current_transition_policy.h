#pragma once
/// Policies for the transition of the currents to a new distribution, by name:
///
///   jump              all set-points at once; the current loops run into their voltage limit
///   ramp              each set-point at most as fast as its coil's voltage allows
///   bias-first        the new bias as by `ramp` with the old control currents; then the new ones
///   force-preserving  a straight line, corrected to the wanted force at every step
///                     (network_force.h)
///   time-optimal      a straight line, so fast that a coil of the coupled network is at its limit
#include <string>

#include "control/current/current_transition.h"
#include "faulttolerance/redistribution/force_forms.h"

namespace ambrig {

/// All a policy may know.
struct TransitionStart {
  CoilVector now = CoilVector::Zero();          // set-points in force, 0 in lost coils [A]
  CoilVector bias_before = CoilVector::Zero();  // [A]
  CoilVector bias_after = CoilVector::Zero();   // [A]
  RedistributionProblem bearing;                // with the turns that are left
  double leakage = 0;                           // inductance of a healthy coil [H]
  double voltage = 0;                           // that the bridges can spare for a change [V]
  double period = 0;                            // of the controller [s]
};

/// "jump,ramp,...": for file readers.
inline constexpr const char* kCurrentTransitionNames =
    "jump,ramp,bias-first,force-preserving,time-optimal";
inline constexpr const char* kDefaultCurrentTransition = "jump";

/// @throws std::logic_error for another name.
std::unique_ptr<CurrentTransition> MakeCurrentTransition(const std::string& name,
                                                         const TransitionStart& start);

/// Inductances of the coupled coils, rotor centred [H]; a unit row for coils without turns.
CoilForm InductanceOf(const TransitionStart& start);

// One file each.
std::unique_ptr<CurrentTransition> MakeJump();
std::unique_ptr<CurrentTransition> MakeRamp(const TransitionStart& start);
std::unique_ptr<CurrentTransition> MakeBiasFirst(const TransitionStart& start);
std::unique_ptr<CurrentTransition> MakeForcePreserving(const TransitionStart& start);
std::unique_ptr<CurrentTransition> MakeTimeOptimal(const TransitionStart& start);

/// Largest change of each set-point in one period by its own inductance and `voltage` [A].
CoilVector RampStep(const TransitionStart& start);

}  // namespace ambrig
