#pragma once
/// The fast engine: lockstep samples at the ADC rate with the exact switching edge inside a sample,
/// one period of all bearings, then one step of the rotor, then the controller's clock.
/// Timing: docs/theory/base_model.md sections 3 and 4. Structure: docs/theory/engine.md.
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "rotor/motion/rotor_stepper.h"
#include "scenarios/faults/fault_ends.h"
#include "simulation/sampled/sampled_data_loop.h"
#include "simulation/verdict/run_watch.h"

namespace ambrig {

class FaultedPlant;
struct FaultPlace;

struct EngineOptions : SampledOptions, RunControl {
  bool record = true;
  bool snapshots = false;
  // [s] of contact after which the rotor counts as lost: throws
  double lost_after = kInfinity;
  bool watch = true;                // events and figures of the verdict
  bool force_general_path = false;  // tests: the slow path must give the same record
  // tests of convergence: finer steps inside a sample
  int substeps = 1;
  // measured set-points and readings drive the coils; no rotor
  const Record* forced = nullptr;
  // [Hz], above 0: measured currents of `forced` drive the rotor, the gaps follow its readings, and
  // so does the rotor itself through an observer of this frequency
  double observer = 0;
  /// Who moves the rotor; empty: RotorModel::Step.
  std::function<std::unique_ptr<RotorStepper>(const RotorModel&)> stepper = {};
};

class SwitchingEngine {
 public:
  SwitchingEngine(const RigParameters& rig, const Scenario& scenario, const EngineOptions& options);
  ~SwitchingEngine();
  RunResult Run();

  // The same in parts, for who moves the clock himself (simulation/stepped/stepped_run.h).
  void Begin();
  /// Periods in their order, from -loop().warm.
  void Period(long long n);
  RunResult Finish();
  /// A fault at its time, which no period has passed yet; the place in the rig was checked.
  void AddFault(const FaultSpec& fault) { added_faults_.push_back(fault); }
  SampledDataLoop& loop() { return loop_; }
  const std::vector<RunEvent>& events() const { return result_.events; }

 private:
  struct BearingRun;

  void Start();
  void StartForced();
  void FollowData(long long n);
  bool CurrentsAreForced() const { return options_.forced && options_.observer > 0; }
  void StartForcedRotor();
  void RunForcedCurrents(long long n);
  void Observe();
  void ForcedPosition(const SampledBearing& b, double t, double* x, double* y) const;
  void SetPatterns(BearingRun& b);
  void SetPattern(BearingRun& b, int j) const;
  void PredictPositions();
  void RunMagnetics(long long n);
  void RunBearings();
  void RunSamplesInLockstep(long long n, const std::vector<const FaultSpec*>& due);
  void Measure(long long n);
  void MoveRotor(long long n);
  void MoveBearings();
  void Watch(long long n);
  class FaultedLanes;
  void Inject(const FaultSpec& fault);
  void EndFaultsBefore(double t);
  /// What follows from a change of the plant at `place`.
  void AfterFault(const FaultPlace& place, const FaultedPlant& changed);
  void HeatCopper();
  void Snapshot(const std::string& label);

  EngineOptions options_;
  SampledDataLoop loop_;
  // the loop's, by shorter names
  const Scenario& scenario_ = loop_.scenario;
  Plant& plant_ = loop_.plant;
  MotionState& motion_ = loop_.motion;
  const double T_ = loop_.T;  // switching period [s]

  std::unique_ptr<RotorStepper> stepper_;
  MotionState ahead_;           // as predicted for the end of the period
  DofVector magnetic_force_{};  // generalised, of this period
  DofVector acceleration_{};
  std::vector<BearingRun> bearings_;
  std::size_t next_fault_ = 0, next_added_ = 0;
  std::deque<FaultSpec> added_faults_;  // their places stay: ends of faults point to them
  FaultEnds fault_ends_;
  std::vector<const FaultSpec*> due_faults_;
  std::vector<StatorLanes::PeriodOfBearing> together_;
  RunResult result_;
  RunWatch watch_;
  double touching_ = 0;       // [s]
  Eigen::MatrixXd observed_;  // displacements of the rotor from readings
};

}  // namespace ambrig
