#pragma once
/// Policies for moving the currents to a new distribution, by name:
///
///   jump              all set-points at once; the current loops run into their voltage limit
///   ramp              each set-point at most as fast as its coil's voltage allows
///   bias-first        the new bias at the ramp's pace while the old control part is kept,
///     then that
///   force-preserving  all on one line,
///     set back onto the wanted force at every step (network_force.h)
///   time-optimal      all on one line,
///     so fast that one coil of the coupled network is at its limit
#include <string>

#include "control/current/hand_over.h"
#include "faulttolerance/redistribution/force_forms.h"

namespace ambrig {

/// All a policy may know.
struct HandOverStart {
  Coils now = Coils::Zero();          // set-points in force, 0 in lost coils [A]
  Coils bias_before = Coils::Zero();  // [A]
  Coils bias_after = Coils::Zero();   // [A]
  RedistributionProblem bearing;      // with the turns that are left
  double leakage = 0;                 // inductance of a healthy coil [H]
  double voltage = 0;                 // that the bridges can spare for a change [V]
  double period = 0;                  // of the controller [s]
};

/// "jump,ramp,...": for file readers.
inline constexpr const char* kHandOverNames = "jump,ramp,bias-first,force-preserving,time-optimal";
inline constexpr const char* kDefaultHandOver = "jump";

/// @throws std::logic_error for another name.
std::unique_ptr<HandOver> MakeHandOver(const std::string& name, const HandOverStart& start);

/// Inductances of the coupled coils, rotor centred [H]; a unit row for coils without turns.
CoilForm InductanceOf(const HandOverStart& start);

// One file each.
std::unique_ptr<HandOver> MakeJump();
std::unique_ptr<HandOver> MakeRamp(const HandOverStart& start);
std::unique_ptr<HandOver> MakeBiasFirst(const HandOverStart& start);
std::unique_ptr<HandOver> MakeForcePreserving(const HandOverStart& start);
std::unique_ptr<HandOver> MakeTimeOptimal(const HandOverStart& start);

/// Largest change of each set-point in one period by its own inductance and `voltage` [A].
Coils RampStep(const HandOverStart& start);

}  // namespace ambrig
