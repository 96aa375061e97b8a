#pragma once
/// The sampled side of a run, one for all engines: start states, readings, position loop, current
/// regulators, measurements, the supervisor and its actions, rows of the record. What
/// an engine adds is how the plant moves from t_n to t_(n+1). The clocks are those of
/// docs/theory/base_model.md sections 3 and 4:
///
///   t_n = n T        readings; set-points that are due; duty of period n from the feedback of n-1
///   n % M == 0       position loop; its set-points act one controller period later
///
/// It is the only place at which the true rig (plant) and the nominal rig (controllers) meet.
#include <atomic>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/linear/equilibrium.h"
#include "faulttolerance/supervision/supervisor.h"
#include "rig/rig_assembly.h"
#include "scenarios/scenario.h"
#include "simulation/record/run_result.h"
#include "simulation/sampled/command_plan.h"
#include "simulation/sampled/current_loops.h"
#include "simulation/sampled/measurement_noise.h"
#include "simulation/sampled/position_loop.h"
#include "simulation/sampled/run_record.h"
#include "simulation/sampled/sampled_bearing.h"

namespace ambrig {

struct SampledOptions {
  double record_rate = 0;                           // 0: the scenario's
  std::vector<std::string> recorded_channels = {};  // empty: all
  // of these rows, which rise, and of the last one consists the record; nullptr: of all
  const std::vector<std::size_t>* recorded_rows = nullptr;
  bool noise = true;        // false: none, whatever the scenario says
  bool coil_spread = true;  // false: every coil nominal, as models of measured rigs have them
  // [s] before t = 0; negative: docs/theory/base_model.md's (tests: shorter)
  double warm_up = -1;
  // what the controller knows; default: the rig file's values
  const NominalRig* nominal = nullptr;
  Supervisor* supervisor = nullptr;
  const CommandPlan* commands = nullptr;  // shared between runs of one scenario
};

/// Who may look at a run while it goes on, and stop it.
struct RunControl {
  std::function<void(double)> progress = {};  // fraction done
  const std::atomic<bool>* stop = nullptr;    // set: throw Interrupted
};

class SampledDataLoop {
 public:
  /// `rig`: as its file gives it. The plant gets its true values, the controllers the nominal ones.
  SampledDataLoop(const RigParameters& rig, const Scenario& scenario,
                  const SampledOptions& options);
  SampledDataLoop(const SampledDataLoop&) = delete;
  SampledDataLoop& operator=(const SampledDataLoop&) = delete;

  /// The scenario's start: motion, set-points, integrals. The coils then carry the set-points.
  void Start();
  /// Coils driven by measured data over a rotor that stands: no position loop, `warm_up` [s] before
  /// t = 0. The engine then gives set-points and calls StartDriven.
  void PrepareDriven(CurrentLoops::SetPoints source, double warm_up);
  void StartDriven();
  /// A levitated start in the equilibrium of the shaft instead of its centre.
  Equilibrium StartInEquilibrium();

  /// Calls period(n) for every period from the warm-up to the end, asking `watcher` every
  /// `every` periods (a power of two). @throws Interrupted when stopped.
  template <class Period>
  void ForEachPeriod(const RunControl& watcher, long long every, const Period& period) const {
    for (long long n = -warm; n < periods; ++n) {
      if ((n & (every - 1)) == 0) Look(watcher, n);
      period(n);
    }
  }
  /// Everything that is sampled at t_n, before the plant moves on.
  void AtPeriodStart(long long n);
  /// Voltages of coil j over this period with the imperfections of its bridge. `current`:
  /// of the coil now [A].
  CoilVoltage PatternOf(const SampledBearing& b, int j, double current) const;
  /// The true samples of period n of one bearing (b.measurement.samples of them).
  void Measure(long long n, SampledBearing& b, const Lane* truth);
  /// All bearings of period n are measured: feedback, rows inside the period.
  void EndMeasurement(long long n);
  /// What was measured in period n goes to the supervisor; its actions are carried out,
  /// its events go into the result. Returns how many events came.
  std::size_t Supervise(long long n, RunResult& result);
  /// Shaft centres at the bearings from `motion`.
  void UpdatePositions();
  /// What the sensors show at t_n, before period n begins. Nothing of the controller changes.
  void ReadAhead(long long n);
  /// Where the values of all channels are read.
  RowSource ValueSource();

  void StartRecord();
  Record TakeRecord() { return record_ ? record_->Take() : Record{}; }
  const CommandPlan& commands() const { return *commands_; }

  const TrueRig true_rig;
  const RigParameters& rig = *true_rig;
  const NominalRig nominal;
  const bool as_drawn;      // the true rig is the nominal one
  const Scenario scenario;  // noise as asked for
  const SampledOptions options;
  Plant plant;
  MotionState motion;
  std::vector<SampledBearing> bearings;
  std::vector<BearingControl> control;
  std::vector<double> bus_samples;  // of a bus that moves, as the engine passes them [V]
  double T = 0, h = 0;              // switching period, ADC sample [s]
  int M = 1, samples = 18;          // periods per controller period, ADC samples per period
  bool clamped = false;             // nothing moves the rotor
  long long warm = 0, periods = 0;

 private:
  void AddBearing(std::size_t k, std::size_t first_axis);
  void StartLevitated();
  void StartClamped();
  void BeginUnderCurrent();  // coils whose currents at t = 0 the scenario gives
  void StartResting();
  void HoldForces(const std::vector<double>& force);
  void FinishStart();
  void Look(const RunControl& watcher, long long n) const;
  /// Where the bridges really switch in period n.
  void MoveEdges(long long n);
  /// The actions whose computing time is over in period n.
  void CarryOut(long long n);
  /// The scenario's retuned_controller, designed for the maps in force, takes over.
  void Retune(double t);

  std::unique_ptr<CommandPlan> own_commands_;
  const CommandPlan* commands_;
  std::optional<PositionLoop> loop_;
  std::vector<CurrentMap> maps_;  // in force, as a synthesis takes them; empty: healthy ones
  CurrentLoops current_loops_;
  bool controller_on_ = true;
  std::optional<MeasurementNoise> noise_;
  SampleInstants instants_;  // of the period after that
  long long instants_of_ = std::numeric_limits<long long>::min();
  std::optional<RunRecord> record_;
  PeriodMeasurement measurement_;  // kept: no allocation in the loop
  SupervisorOutput supervision_;
  struct Computed {
    long long due = 0;  // period at whose end they act
    std::vector<ControlAction> actions;
  };
  std::deque<Computed> computed_;  // actions on their way
  long long computing_ = 0;        // periods that an action takes
};

}  // namespace ambrig
