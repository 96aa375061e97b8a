#pragma once
/// Commissioned detectors of whole runs of the switching engine, on plants whose effects are no
/// part of any detector's model. None acts on the run; what each of them concludes is kept.
#include <fmt/format.h>

#include <memory>
#include <set>

#include "fdd/commissioned/commissioned_run.h"
#include "fdd/detectors/detection_feed.h"
#include "simulation/commissioning/commission.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig::testing_plant {

/// What one detector concluded, in the order of the periods.
struct ConcludedPeriod {
  double t = 0;  // end of the period [s]
  DetectorAlarm alarm;
  bool doubtful = false;
};

/// The detector of one bearing beside a run: of the one that was commissioned, else of the first.
class ConclusionLog : public Supervisor {
 public:
  ConclusionLog(const NominalRig& rig, const CommissionedBearing* commissioned)
      : feed_(rig), period_(1 / rig->amplifier.switching_frequency) {
    while (commissioned && rig->bearings[bearing_].name != commissioned->name) ++bearing_;
    const BearingParameters& b = rig->bearings[bearing_];
    const LinkageModel m = LinkageModelOf(b);
    run_ =
        std::make_unique<CommissionedRun>(CoilDetectorSetup{m, DetectorSettingsOf(rig, b, m)},
                                          commissioned ? *commissioned : NominalBearing(b.name, m));
  }
  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                   SupervisorOutput&) override {
    feed_.Read(m);
    MeasuredPeriod in = feed_.Period(bearing_, m);
    in.set_point = &control[bearing_].commanded;
    const DetectorAlarm alarm = run_->Period(in);
    doubted = doubted || run_->doubtful();
    if (alarm.carrying >= 0) carried.emplace_back(alarm.carrying, alarm.carried);
    if (alarm.diagnosis.cls == FaultClass::kNone && !alarm.raised) return;
    periods.push_back({m.t + period_, alarm, run_->doubtful()});
    found.push_back(alarm.diagnosis);
    found.insert(found.end(), alarm.more.begin(), alarm.more.end());
  }
  /// Coils that were diagnosed, from 1 as in scenario files.
  std::set<int> Coils() const {
    std::set<int> coils;
    for (const Diagnosis& d : found) coils.insert(d.coil + 1);
    return coils;
  }
  std::vector<ConcludedPeriod> periods;
  std::vector<Diagnosis> found;
  std::vector<std::pair<int, double>> carried;  // coil from 0, share of its turns that carries
  bool doubted = false;

 private:
  DetectionFeed feed_;
  std::size_t bearing_ = 0;
  double period_;
  std::unique_ptr<CommissionedRun> run_;
};

/// A run-up with a load step and an orbit of a quarter of the clearance.
inline std::string Operation(const std::string& faults, double duration = 0.04) {
  return fmt::format(R"(name = "operation"
rig = "rig.toml"
duration = {0}
record_rate = 1000.0
seed = 9
[start]
state = "levitated"
[speed]
profile = [[0.0, 0.0], [0.05, 600.0]]
[[excitation]]
target = "A.x"
port = "reference"
kind = "sine"
start = 0.0
stop = {0}
frequency = 40.0
amplitude = 5e-5
[[excitation]]
target = "A.y"
port = "force"
kind = "step"
start = 0.02
stop = {0}
amplitude = -10.0
)",
                     duration) +
         faults;
}

inline constexpr double kOnset = 0.0300123;  // [s]

inline std::string FaultOf(int coil, const std::string& kind, const std::string& parameters = "",
                           double t = kOnset, const std::string& bearing = "A") {
  return fmt::format("[[fault]]\ntarget = \"{}.coil{}\"\ntime = {:.7f}\nkind = \"{}\"\n{}\n",
                     bearing, coil, t, kind,
                     parameters.empty() ? "" : "parameters = { " + parameters + " }");
}

inline std::unique_ptr<ConclusionLog> Concluded(const RigParameters& rig,
                                                const CommissionedBearing* commissioned,
                                                const std::string& text) {
  const Scenario scenario = ReadScenarioText(text, "operation.toml", rig);
  auto log = std::make_unique<ConclusionLog>(NominalRig(rig), commissioned);
  EngineOptions engine;
  engine.record = false;
  engine.supervisor = log.get();
  SwitchingEngine(rig, scenario, engine).Run();
  return log;
}

/// A rig with effects, and what its own detector learnt of a bearing.
struct CommissionedRig {
  RigParameters rig;
  CommissionedBearing bearing;
  explicit CommissionedRig(const RigParameters& plant, const std::string& name = "A") : rig(plant) {
    CommissioningOptions options;
    options.plan.duration = 0.2;
    bearing = *Commission(rig, options).model.Find(name);
  }
};

/// A run with a short of one coil beside the detector of its bearing.
inline std::unique_ptr<ConclusionLog> ConcludedShort(const CommissionedRig& plant, int coil,
                                                     const std::string& parameters,
                                                     double duration) {
  return Concluded(plant.rig, &plant.bearing,
                   Operation(FaultOf(coil, "partial-short", parameters), duration));
}

/// Without effects.
inline const CommissionedRig& BaseModel() {
  static const CommissionedRig made(ReferenceRig());
  return made;
}

/// Eddy currents from 1 kHz on, fringing, a moved sensor.
inline const CommissionedRig& SlowIron() {
  static const CommissionedRig made([] {
    RigParameters rig = WithEffect(ReferenceRig(), "eddy-currents", "A", {{"cutoff", 1000}});
    rig = WithEffect(rig, "fringing", "A", {{"coefficient", 0.15}});
    return WithEffect(rig, "sensor-offset", "A.x", {{"offset", 1e-5}});
  }());
  return made;
}

/// Hysteresis, eddy currents of thin sheets, a stator that does not sit where it is drawn.
inline const CommissionedRig& ThinSheets() {
  static const CommissionedRig made([] {
    RigParameters rig = WithEffect(ReferenceRig(), "eddy-currents", "A", {{"cutoff", 10000}});
    rig = WithEffect(rig, "hysteresis", "A", {{"coercive", 0.05}});
    return WithEffect(rig, "magnetic-offset", "A", {{"dx", 1e-5}});
  }());
  return made;
}

}  // namespace ambrig::testing_plant
