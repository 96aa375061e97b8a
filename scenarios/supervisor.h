#pragma once
/// Seam between the engine and what watches it in the controller: fault detection and
/// redistribution. It sees what a real controller sees, never the plant.
#include <array>
#include <string>
#include <vector>

#include "actuators/amplifier.h"
#include "actuators/stator_lanes.h"
#include "control/current_map.h"
#include "control/hand_over.h"
#include "scenarios/run_result.h"

namespace ambrig {

/// The controller's side of one bearing.
struct BearingControl {
  std::string name;
  int coils = 0;
  CurrentMap map;
  std::shared_ptr<HandOver> hand_over;  // on the way to `map`'s currents; empty: there
  std::array<PowerAmplifier, kLanes> amplifier;
  Lane set_point;                       // in force, without excitation [A]
  Lane commanded;                       // with the coil's current excitation [A]
  Lane duty, feedback;                  // of this period [-]; mean of the last period's samples [A]
  std::array<bool, kLanes> disabled{};  // bridge kept off by the controller
};

/// What was measured of one bearing over one switching period.
struct BearingMeasurement {
  const Lane* adc = nullptr;   // samples k = 0..n-1 [A]
  const Lane* duty = nullptr;  // that was applied [-]
  double bus = 0;              // measured supply [V]
};

struct PeriodMeasurement {
  long long period = 0;  // n; t_n = n T
  double t = 0;          // t_n [s]
  int samples = 0;
  std::vector<BearingMeasurement> bearings;
  const std::vector<double>* readings = nullptr;  // last noisy position readings per axis [m]
  double reading_time = 0;                        // [s]
  bool position_loop = true;                      // false: clamped, set-points come from outside
};

class Supervisor {
 public:
  virtual ~Supervisor() = default;
  /// After period n is measured; may change maps, integrals, `disabled`, and add events.
  virtual void AfterPeriod(const PeriodMeasurement& m, std::vector<BearingControl>& control,
                           std::vector<RunEvent>& events) = 0;
  virtual void Finish(RunResult&) {}
};

}  // namespace ambrig
