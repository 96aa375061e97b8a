#pragma once
/// Fault tolerance of a rig at run time: one detector per bearing, that of the rig's [detection]
/// (fdd/detectors/run_detector.h), built from the nominal rig, then redistribution of the currents
/// (faulttolerance/) over the coils that are left.
///
/// After a diagnosis of a coil fault, in the same period:
///   - a lost coil (open, amplifier, switch, sensor) is disabled; a partial short keeps 1 - s turns
///   - W of the bearing's failure set replaces the map: the next set-points use it, the force
///     command of the position loop stays as it is (bumpless in force)
///   - every regulator's integral is moved by what its new current needs (bumpless in voltage)
///   - a coil that was switched off is looked at again and may return (coil_probes.h)
/// A bearing whose controller commands currents itself is told so ("not_redistributed"):
/// its map waits for a controller that uses it, and its regulators are left alone. So is one that
/// nothing is left of that gives its forces, though its coils that work go on with what they can.
/// Thrust bearings: the winding that is left on a side carries the missing ampere-turns.
#include <deque>
#include <map>
#include <memory>

#include "faulttolerance/redistribution/redistribution_table.h"
#include "faulttolerance/supervision/current_transition_policy.h"
#include "faulttolerance/supervision/supervisor.h"
#include "fdd/detectors/detection_feed.h"
#include "fdd/detectors/run_detector.h"
#include "rig/nominal_rig.h"

namespace ambrig {

struct FaultSupervisorOptions {
  bool redistribute = true;
  /// auto: W when it is exact or its force at the command of now is true within 15 % (and what W
  /// leaves open is small), else force by force (faulttolerance/redistribution/force_inverse.h)
  /// where that holds, else the W of least error. matrix: always W. force-by-force: always that,
  /// where it holds.
  std::string redistribution = "auto";
  std::string current_transition = kDefaultCurrentTransition;
  bool stiffness_compensation = true;  // f + (K_healthy - K_W) x
  bool slopes = false;                 // slope traces round the first alarm, for the report
  std::string cache_dir;               // of the redistribution tables; empty: memory only
};

class FaultSupervisor : public Supervisor {
 public:
  FaultSupervisor(const NominalRig& nominal, const FaultSupervisorOptions& options);
  ~FaultSupervisor() override;

  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                   SupervisorOutput& out) override;
  SupervisorSummary Summary() const override;

  double coil_periods() const { return coil_periods_; }
  /// Of the last period; zeros where nothing watches the coil.
  SlopeBand Band(std::size_t bearing, int coil) const;

 private:
  struct Watched;
  void WatchBus(double t, double reading, std::vector<RunEvent>& events);
  void WatchPositions(const PeriodMeasurement& m, std::vector<RunEvent>& events);
  void WatchBearing(std::size_t k, const PeriodMeasurement& m, const BearingControl& control,
                    SupervisorOutput& out);
  void ActOn(const DetectorAlarm& alarm, Watched& w, double t, bool position_loop,
             const BearingControl& control, SupervisorOutput& out);
  /// Says once in a run that the model of the bearing is doubtful.
  void Doubt(Watched& w, double t, std::vector<RunEvent>& events);
  /// A diagnosis is not acted on: the detector is told that the coil goes on as before.
  static void Refuse(Watched& w, const Diagnosis& d);
  /// The class of the map with these turns left.
  std::string ClassOfMap(Watched& w, const CoilVector& turns_left, const BearingControl& control);
  /// The class of the map that would be taken without a coil.
  std::string ClassWithout(Watched& w, int coil, const BearingControl& control);
  /// A coil whose derating made the orbit grow is switched off: its turns are not what its slopes
  /// say (a closed loop of shorted turns), or its current loop is not stable with so few.
  void TakeOutDerated(Watched& w, double t, const BearingControl& control, SupervisorOutput& out);
  /// Another share of a derated coil's turns carries the shaft than was told at first.
  void FollowCarried(Watched& w, const DetectorAlarm& alarm, double t, bool position_loop,
                     const BearingControl& control, SupervisorOutput& out);
  /// Whether a coil whose reading is false is the last that carries, or the last of a thrust side:
  /// what it gives with a false reading is more than nothing.
  bool NothingElseCarries(Watched& w, const DetectorAlarm& alarm, const BearingControl& control);
  /// What is left of the coil's turns; a lost coil's bridge is kept off.
  void Disable(Watched& w, const Diagnosis& d, SupervisorOutput& out);
  void Redistribute(Watched& w, double t, const BearingControl& control, SupervisorOutput& out);
  /// That the bearing's currents follow a map of class `cls`, or why they do not.
  static void TellRedistribution(const Watched& w, double t, const std::string& cls,
                                 std::vector<RunEvent>& events);
  /// A second look at coils that were given up, a first one at coils that lie idle.
  void Probe(Watched& w, double t, const MeasuredPeriod& in, bool position_loop,
             const BearingControl& control, SupervisorOutput& out);
  void EndIdleProbe(Watched& w, int coil, double t, const BearingControl& control,
                    SupervisorOutput& out);
  void Restore(Watched& w, int coil, double turns, double t, const std::string& reason,
               bool position_loop, const BearingControl& control, SupervisorOutput& out);
  /// Every regulator's integral is moved by what its new current needs.
  static void MoveIntegrals(const Watched& w, const BearingControl& control, const CoilVector& next,
                            SupervisorOutput& out);
  /// The bearing's new map for `force` [N] after its faults; returns its class for the record.
  std::string NewMap(Watched& w, const Eigen::Vector2d& force, CurrentMap* map);
  /// The way from the set-points in force to those of the new map.
  std::unique_ptr<CurrentTransition> NewCurrentTransition(const Watched& w, const CurrentMap& map,
                                                          const Eigen::Vector2d& force,
                                                          const BearingControl& control) const;
  void TraceSlopes(double t);

  const NominalRig rig_;
  FaultSupervisorOptions options_;
  double T_ = 0;  // [s]
  bool bus_sagged_ = false;
  double bus_ = 0, bus_weight_ = 1;  // smoothed reading [V]; share of each new one
  DetectionFeed feed_;
  std::vector<std::unique_ptr<Watched>> watched_;
  std::vector<CoilAction> actions_;
  bool doubtful_ = false, interfered_ = false;
  double coil_periods_ = 0;

  struct SlopeRow {
    double t = 0;
    std::vector<std::array<Lane, 3>> bearings;  // slope, expected, half-width
  };
  std::deque<SlopeRow> rows_;
  double first_alarm_ = -1;
  std::size_t alarm_bearing_ = 0;
  int alarm_coil_ = 0;
};

}  // namespace ambrig
