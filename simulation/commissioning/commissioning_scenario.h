#pragma once
/// The run in which a detector gets to know its healthy machine, in four parts of its duration:
///
///   0 to 15 %    hovering, at speed zero
///   15 to 45 %   a multisine of its own on every coil's current: 60 Hz to 2 kHz
///   15 to 60 %   a chirp of the rotor's potential, to 6 % of the switching frequency
///   30 to 65 %   a circle of the reference, 30 % of the clearance, both planes together and then
///                against each other
///   60 to 85 %   chirp of the force on every axis, to 600 Hz
///   85 to 100 %  pulses of the force, up to the largest that the machine will see
///
/// and a run-up to speed from 55 % on, because run-out shows only when the shaft turns. Without
/// movement the geometry cannot be learnt: hovering alone leaves false alarms.
///
/// The potential of a floating rotor moves when the ampere-turns of all poles change alike, with
/// the sense of their windings: no flux and no force follow, only the linkage of the leakage. A
/// healthy machine never does that, so that its leakage past the rotor and the fringing into the
/// rotor look alike. Coils of one polarity that lose turns do it, and a model that took one for the
/// other then blames their healthy neighbours.
#include "scenarios/scenario.h"

namespace ambrig {

struct CommissioningPlan {
  double duration = 0.4;    // [s]
  double speed = 1000;      // at its end [rad/s]; 0: a rig that does not turn
  double current = 0.03;    // amplitude of each of a coil's three tones [A]
  double potential = 0.25;  // of the bias current: chirp of the rotor's potential
  double circle = 0.3;      // of the clearance
  double chirp = 0.13;      // of f_max
  double pulse = 0.4;       // of f_max: the largest force to come
  std::uint64_t seed = 1;
};

/// @throws InputError for a plan that the rig cannot run.
Scenario CommissioningScenario(const RigParameters& rig, const CommissioningPlan& plan);

}  // namespace ambrig
