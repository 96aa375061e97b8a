#pragma once
/// One call for every fidelity: a rig and a scenario in, record, events and verdict out.
#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "rotor/motion/rotor_stepper.h"
#include "scenarios/scenario.h"
#include "simulation/record/run_result.h"

namespace ambrig {

class RotorModel;

enum class Fidelity { kSwitching, kReference, kAveraged };

struct SimulateOptions {
  Fidelity fidelity = Fidelity::kSwitching;
  double record_rate = 0;   // 0: the scenario's
  bool for_report = false;  // also snapshots of fluxes and slope traces
  bool record = true;       // false: figures of the verdict only (switching)
  /// Who moves the rotor (switching); empty: RotorModel::Step.
  std::function<std::unique_ptr<RotorStepper>(const RotorModel&)> stepper = {};
  std::function<void(double)> progress;
  const std::atomic<bool>* stop = nullptr;
};

/// @throws InputError for what this fidelity cannot do, Interrupted when stopped.
RunResult Simulate(const RigParameters& rig, const Scenario& scenario,
                   const SimulateOptions& options);

/// Fidelity by its name on the command line. @throws InputError
Fidelity FidelityByName(const std::string& name);

}  // namespace ambrig
