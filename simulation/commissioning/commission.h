#pragma once
/// Commissioning: simulates the healthy machine as it truly is (effects, fitted values) through
/// commissioning_scenario.h, and lets the detectors of all bearings learn from what the controller
/// measured and from the nominal rig, from nothing else.
#include <atomic>
#include <functional>

#include "fdd/learning/commissioned_model.h"
#include "simulation/commissioning/commissioning_scenario.h"
#include "simulation/record/run_result.h"

namespace ambrig {

/// Spread of the statistic c over ten periods against what the machine did then, of one bearing.
struct ExcessScatter {
  struct Bin {
    double from = 0, to = 0;      // of the quantity
    double rms = 0, largest = 0;  // of c over all coils [-]
    long long periods = 0;
  };
  std::string quantity, unit;  // "displacement", "m"
  std::vector<Bin> bins;
};

struct CommissioningResult {
  CommissionedModel model;
  RunResult run;  // events and figures of the run: it must not have touched
  std::vector<std::vector<ExcessScatter>> scatter;  // per bearing
};

struct CommissioningOptions {
  CommissioningPlan plan;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double)> progress;  // fraction done
};

/// @throws InputError when the machine touches in its commissioning run, Interrupted.
CommissioningResult Commission(const RigParameters& rig, const CommissioningOptions& options);

}  // namespace ambrig
