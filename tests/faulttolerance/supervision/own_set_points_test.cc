// A controller that commands currents itself does not use the current map: nothing is redistributed
// then, and nothing may say so.
#include "simulation/verdict/expect.h"
#include "tests/faulttolerance/supervision/supervised_runs.h"

namespace ambrig {
namespace {

/// The reference rig, its force law inverted by the controller in place of the map.
RigParameters RigWithController(const std::string& kind) {
  std::string text = kRig;
  const std::string pid = "kind = \"pid\"";
  return ReadRigText(text.replace(text.find(pid), pid.size(), "kind = \"" + kind + "\""),
                     "rig.toml");
}

/// What the supervisor asks for in the period in which it replaces the map of a bearing.
class MapWitness : public Supervisor {
 public:
  explicit MapWitness(const RigParameters& rig) : inner_(NominalRig(rig), Options()) {}
  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                   SupervisorOutput& out) override {
    inner_.AfterPeriod(m, control, out);
    int integrals = 0;
    bool replaced = false;
    for (const ControlAction& action : out.actions) {
      integrals += std::holds_alternative<SetIntegral>(action) ? 1 : 0;
      const auto* change = std::get_if<ReplaceMap>(&action);
      if (!change) continue;
      replaced = true;
      transition = transition || change->current_transition != nullptr;
      lost_row = change->map.W.row(2).norm();
    }
    if (replaced) maps += 1, moved_integrals += integrals;
  }
  int maps = 0, moved_integrals = 0;
  bool transition = false;
  double lost_row = -1;  // of the third coil [-]

 private:
  static FaultSupervisorOptions Options() {
    FaultSupervisorOptions options;
    options.cache_dir = ::testing::TempDir() + "ambrig_fdd_tables";
    return options;
  }
  FaultSupervisor inner_;
};

struct WitnessedRun {
  Scenario scenario;
  RunResult result;
  int maps = 0, moved_integrals = 0;
  bool transition = false;
  double lost_row = -1;
};

/// A coil opens 2 ms before the end: no probe of it comes.
WitnessedRun OpenCoilUnder(const std::string& kind) {
  const RigParameters rig = RigWithController(kind);
  WitnessedRun run;
  run.scenario =
      ReadScenarioText("name = \"t\"\n" + Spin(0.022, 157, 1) +
                           FaultTable(0.02, "A.coil3", "open") + "[expect]\nredistributed = true\n",
                       "t.toml", rig);
  MapWitness witness(rig);
  EngineOptions engine;
  engine.record = false;
  engine.supervisor = &witness;
  run.result = SwitchingEngine(rig, run.scenario, engine).Run();
  ScoreDetection(run.scenario, run.result);
  run.maps = witness.maps;
  run.moved_integrals = witness.moved_integrals;
  run.transition = witness.transition;
  run.lost_row = witness.lost_row;
  return run;
}

const RunEvent* EventOf(const RunResult& r, const std::string& kind) {
  for (const RunEvent& e : r.events)
    if (e.kind == kind) return &e;
  return nullptr;
}

TEST(OwnSetPoints, AreNotRedistributedAndNothingSaysSo) {
  const WitnessedRun run = OpenCoilUnder("feedback-linearisation");
  ASSERT_NE(EventOf(run.result, "classified"), nullptr);
  EXPECT_EQ(EventOf(run.result, "redistributed"), nullptr);
  const RunEvent* told = EventOf(run.result, "not_redistributed");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->target, "A");
  EXPECT_EQ(told->fault_class, "own set-points");
  EXPECT_EQ(run.result.metrics.redistribution_delay, -1);
  const auto expect = CheckExpectations(run.scenario, run.result);
  ASSERT_EQ(expect.size(), 1u);
  EXPECT_EQ(expect[0].got, "false");
  EXPECT_FALSE(expect[0].met);
}

// Regulators are told the controller's currents as before; the map alone is made ready for a
// controller that uses it.
TEST(OwnSetPoints, KeepTheirRegulatorsIntegrals) {
  const WitnessedRun own = OpenCoilUnder("feedback-linearisation"), mapped = OpenCoilUnder("pid");
  EXPECT_EQ(own.maps, 1);
  EXPECT_EQ(own.moved_integrals, 0);
  EXPECT_FALSE(own.transition);
  EXPECT_EQ(own.lost_row, 0);
  EXPECT_EQ(mapped.maps, 1);
  EXPECT_EQ(mapped.moved_integrals, 8);
  EXPECT_NE(EventOf(mapped.result, "redistributed"), nullptr);
  EXPECT_EQ(EventOf(mapped.result, "not_redistributed"), nullptr);
  EXPECT_TRUE(AllMet(CheckExpectations(mapped.scenario, mapped.result)));
}

}  // namespace
}  // namespace ambrig
