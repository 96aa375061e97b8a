#pragma once
/// The sampled side of a rig for the engines that run the plant in continuous time (reference,
/// averaged): start states, readings, position loop, current loops, rows of the record.
/// The clocks are those of docs/theory/base_model.md sections 3 and 4, as in the switching engine:
///
///   t_n = n T        readings; set-points that are due; duty of period n from the feedback of n-1
///   n % M == 0       position loop; its set-points act one controller period later
#include <memory>
#include <optional>
#include <vector>

#include "faulttolerance/supervision/supervisor.h"
#include "rig/rig_assembly.h"
#include "scenarios/scenario.h"
#include "simulation/record/run_record.h"
#include "simulation/record/run_result.h"
#include "simulation/sampled/command_plan.h"
#include "simulation/sampled/current_loops.h"
#include "simulation/sampled/measurement_noise.h"
#include "simulation/sampled/position_loop.h"
#include "simulation/sampled/sampled_bearing.h"

namespace ambrig {

struct SampledOptions {
  double record_rate = 0;  // 0: the scenario's
  bool noise = false;      // false: none, whatever the scenario says
  double warm_up = -1;     // [s] before t = 0; negative: docs/theory/base_model.md's
  const RigParameters* nominal = nullptr;
  Supervisor* supervisor = nullptr;
};

/// And its bridges, whose voltages stay as they are over a period or change at a fault.
struct ContinuousBearing : SampledBearing {
  std::array<CoilVoltage, kLanes> voltage;  // of this period
};

class SampledRig {
 public:
  SampledRig(const RigParameters& rig, const Scenario& scenario, const SampledOptions& options);

  /// Start state: motion, set-points, integrals. The coils then carry the set-points.
  void Start();
  /// Replaces a levitated start's forces per axis [N] and motion by an equilibrium.
  void StartFrom(const std::vector<double>& force, const DofVector& q);
  /// Everything that is sampled at t_n, before the plant moves on.
  void AtPeriodStart(long long n);
  /// Duty pattern of coil j with the faults of its bridge, at this period's duty.
  CoilVoltage PatternOf(const SampledBearing& b, int j) const;
  /// The period's true samples (count x coils) become the feedback of the next one.
  void Measure(long long n, const std::vector<const Lane*>& samples, int count);
  void AfterPeriod(long long n, RunResult& result);
  void RecordStart();
  /// Rows inside period n, after Measure (bursts only).
  void RecordBurst(long long n) {
    if (record_) record_->AfterMeasurement(n);
  }
  Record TakeRecord() { return record_ ? record_->Take() : Record{}; }
  /// Shaft centres at the bearings from `motion`.
  void UpdatePositions();

  const RigParameters rig, nominal;  // true values, the controller's
  const Scenario scenario;           // noise as asked for
  const SampledOptions options;
  Plant plant;
  MotionState motion;
  std::vector<ContinuousBearing> bearings;
  std::vector<BearingControl> control;
  double T = 0, h = 0;  // switching period, ADC sample [s]
  int M = 1, samples = 18;
  bool clamped = false;
  long long warm = 0, periods = 0;

 private:
  void StartLevitated();
  void StartClamped();
  void StartResting();
  void SetStartForces(const std::vector<double>& force);

  CommandPlan commands_;
  std::optional<PositionLoop> loop_;
  CurrentLoops current_loops_;
  bool controller_on_ = true;
  std::optional<MeasurementNoise> noise_;
  std::optional<RunRecord> record_;
};

}  // namespace ambrig
