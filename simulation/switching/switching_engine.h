#pragma once
/// The fast engine: lockstep samples at the ADC rate with the exact switching edge inside a sample,
/// one period of all bearings, then one step of the rotor, then the controller's clock.
/// Timing: docs/theory/base_model.md sections 3 and 4. Structure: docs/theory/engine.md.
#include <atomic>
#include <functional>
#include <memory>
#include <optional>

#include "actuators/electronics/current_measurement.h"
#include "faulttolerance/supervision/supervisor.h"
#include "rig/rig_assembly.h"
#include "rotor/motion/rotor_stepper.h"
#include "scenarios/faults/fault_ends.h"
#include "simulation/record/run_record.h"
#include "simulation/record/run_result.h"
#include "simulation/sampled/command_plan.h"
#include "simulation/sampled/current_loops.h"
#include "simulation/sampled/measurement_noise.h"
#include "simulation/sampled/position_loop.h"
#include "simulation/verdict/contact_watch.h"

namespace ambrig {

class FaultedPlant;
struct FaultPlace;

struct EngineOptions {
  double record_rate = 0;  // 0: the scenario's
  bool record = true;
  bool snapshots = false;
  // [s] of contact after which the rotor counts as lost: throws
  double lost_after = kInfinity;
  bool watch = true;                // events and figures of the verdict
  bool force_general_path = false;  // tests: the slow path must give the same record
  // [s] before t = 0; negative: docs/theory/base_model.md's (tests: shorter)
  double warm_up = -1;
  // tests of convergence: finer steps inside a sample
  int substeps = 1;
  // what the controller believes; default: the rig file's values
  const RigParameters* nominal = nullptr;
  // measured set-points and readings drive the coils; no rotor
  const Record* forced = nullptr;
  const CommandPlan* commands = nullptr;  // shared between runs of one scenario
  Supervisor* supervisor = nullptr;
  /// Who moves the rotor; empty: RotorModel::Step.
  std::function<std::unique_ptr<RotorStepper>(const RotorModel&)> stepper = {};
  std::function<void(double)> progress;     // fraction done
  const std::atomic<bool>* stop = nullptr;  // set: throw Interrupted
};

/// Set-points on their way to the current loops.
class SwitchingEngine {
 public:
  SwitchingEngine(const RigParameters& rig, const Scenario& scenario, const EngineOptions& options);
  ~SwitchingEngine();
  RunResult Run();

 private:
  struct BearingRun;

  void Start();
  void StartLevitated();
  void StartClamped();
  void StartResting();
  void StartForced();
  void FollowData(long long n);
  void ForcedPosition(const BearingRun& b, double t, double* x, double* y) const;
  void Period(long long n);
  void SetPatterns(BearingRun& b);
  static void SetPattern(BearingRun& b, int j, const CoilVoltage& v);
  void PredictPositions();
  void RunMagnetics(long long n);
  void RunBearings();
  void RunSamplesInLockstep(long long n, const std::vector<const FaultSpec*>& due);
  void Measure(long long n);
  void MoveRotor(long long n);
  void Watch(long long n);
  void WatchFaults(long long n);
  class FaultedLanes;
  void Inject(const FaultSpec& fault);
  void EndFaultsBefore(double t);
  /// What follows from a change of the plant at `place`.
  void AfterFault(const FaultPlace& place, const FaultedPlant& changed);
  void BusAt(double t);
  void StartRecord();
  void HeatCopper();
  void Snapshot(const std::string& label);
  void Verdict();
  void Event(const std::string& kind, const std::string& target,
             const std::string& fault_class = "", double fraction = 0, double t = -1);

  RigParameters rig_;      // true values
  RigParameters nominal_;  // the controller's
  const Scenario& scenario_;
  EngineOptions options_;
  std::unique_ptr<CommandPlan> own_commands_;
  const CommandPlan* commands_;

  Plant plant_;
  std::unique_ptr<RotorStepper> stepper_;
  MotionState motion_, ahead_;  // now, and as predicted for the end of the period
  DofVector magnetic_force_{};  // generalised, of this period
  DofVector acceleration_{};
  std::vector<BearingRun> bearings_;
  std::vector<BearingControl> control_;

  double T_ = 0, h_ = 0;      // switching period, ADC sample [s]
  int M_ = 1, samples_ = 18;  // periods per controller period, ADC samples per period
  bool clamped_ = false, controller_on_ = true;
  long long warm_ = 0, periods_ = 0;
  std::size_t next_fault_ = 0;
  FaultEnds fault_ends_;
  std::vector<const FaultSpec*> due_faults_;
  std::vector<StatorLanes::PeriodOfBearing> together_;

  std::optional<RunRecord> record_;
  RunResult result_;
  std::optional<ContactWatch> contacts_;
  double loss_sum_ = 0, touching_ = 0, settled_orbit_sq_ = 0;
  PeriodMeasurement measurement_;
  std::optional<MeasurementNoise> noise_;
  std::optional<PositionLoop> loop_;
  std::optional<CurrentLoops> current_loops_;
};

}  // namespace ambrig
