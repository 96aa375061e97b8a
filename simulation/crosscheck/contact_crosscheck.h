#pragma once
/// Two independent models of contact: one scenario through the switching engine with the rotor of
/// rotor/motion/rotor_model.h (compliant contact) and with that of rotor/crosscheck/ode_rotor.h
/// (rigid bodies of the Open Dynamics Engine). Magnets, loops, sensors, faults and detection
/// are the same in both and closed round either rotor.
///
/// A third run, the compliant model with another seed of the noise, shows what a difference of
/// nothing grows to: bouncing is unstable, so paths part after some impacts whatever integrates
/// them. With no noise in the scenario it repeats the first.
#include <atomic>
#include <functional>

#include "rotor/crosscheck/ode_rotor.h"
#include "scenarios/scenario.h"
#include "simulation/verdict/drop_figures.h"

namespace ambrig {

struct CrosscheckOptions {
  OdeOptions ode;
  bool other_noise = true;               // the third run
  std::function<void(double)> progress;  // fraction of all runs
  const std::atomic<bool>* stop = nullptr;
};

struct CrosscheckRun {
  DropFigures figures;
  DropPaths paths;
  std::vector<RunEvent> events;
};

struct ContactCrosscheck {
  CrosscheckRun model, ode, other_noise;
  double parted_ode = -1, parted_noise = -1;  // [s] from `model` by kPartedShare, -1: never
  long ode_steps = 0, ode_warnings = 0;

  bool contact() const { return !model.figures.first.empty() || !ode.figures.first.empty(); }
  bool verdicts_agree() const {
    return model.figures.touchdown == ode.figures.touchdown &&
           model.figures.drop == ode.figures.drop;
  }
};

inline constexpr double kPartedShare = 0.05;  // of the clearance

/// @throws InputError for what ODE's rigid rotor cannot show and for clamped scenarios,
/// Interrupted when stopped.
ContactCrosscheck CrosscheckContact(const RigParameters& rig, const Scenario& scenario,
                                    const CrosscheckOptions& options = {});

}  // namespace ambrig
