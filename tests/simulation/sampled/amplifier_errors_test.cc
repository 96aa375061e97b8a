/// Errors of amplifiers and their measurements that the maker knows by their size only: jitter of
/// samples and of edges, and what differs from coil to coil.
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/continuous/reference_engine.h"
#include "simulation/sampled/coil_spread.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

constexpr double kGainSpread = 0.005, kEdgeSpread = 5e-8;

RigParameters Imperfect() {
  RigParameters rig = BaseRig();
  rig.amplifier.adc_jitter = rig.amplifier.edge_jitter = 2e-8;
  rig.amplifier.edge_spread = kEdgeSpread;
  rig.amplifier.current_gain_spread = kGainSpread;
  return rig;
}

/// Nothing but the weight and the currents acts on the rotor.
Scenario Undisturbed(const RigParameters& rig, double duration, bool noise) {
  Scenario s = BaseScenario("steps", rig);
  s.excitations.clear();
  s.loads.clear();
  s.duration = duration;
  s.noise = noise;
  return s;
}

Record Recorded(const RigParameters& rig, bool noise, bool coil_spread = true) {
  Scenario s = BaseScenario("steps", rig);
  s.duration = 0.01;
  s.noise = noise;
  EngineOptions o;
  o.warm_up = 0.002;
  o.coil_spread = coil_spread;
  return SwitchingEngine(rig, s, o).Run().record;
}

void ExpectSame(const Record& a, const Record& b) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c)
    EXPECT_EQ(a.channels[c].samples, b.channels[c].samples) << a.channels[c].name;
}

// Both integrators get the same edges, the same instants and the same gains.
TEST(AmplifierErrors, TheReferenceHasTheSame) {
  RigParameters rig = Imperfect();
  rig.amplifier.adc_jitter = rig.amplifier.edge_jitter = 2e-7;
  rig.amplifier.edge_spread = 5e-7;
  const Scenario s = Undisturbed(rig, 0.004, true);
  ReferenceOptions o;
  o.sampled.warm_up = 0.002;
  o.sampled.noise = true;
  o.integrator = {1e-10, 5, false};
  const Record reference = RunReference(rig, s, o).record;
  EngineOptions fast;
  fast.warm_up = 0.002;
  fast.substeps = 8;
  const Difference same = Compare(SwitchingEngine(rig, s, fast).Run().record, reference);
  RigParameters exact = rig;
  exact.amplifier.edge_jitter = 0;
  const Difference other = Compare(SwitchingEngine(exact, s, fast).Run().record, reference);
  EXPECT_LT(same.current_rms, 0.1 * other.current_rms);
}

// Noise off: no jitter, but the coils still differ, for they are parts of the machine.
TEST(AmplifierErrors, WithoutNoiseOnlyTheSpreadIsLeft) {
  RigParameters steady = Imperfect();
  steady.amplifier.adc_jitter = steady.amplifier.edge_jitter = 0;
  const Record all = Recorded(Imperfect(), false);
  ExpectSame(all, Recorded(steady, false));
  EXPECT_GT(Compare(all, Recorded(BaseRig(), false)).current_rms, 1e-3);
}

// A model of a measured rig, whose own errors nobody knows, has none.
TEST(AmplifierErrors, AModelOfAMeasuredRigHasNoSpread) {
  RigParameters jittery = Imperfect();
  jittery.amplifier.edge_spread = jittery.amplifier.current_gain_spread = 0;
  ExpectSame(Recorded(Imperfect(), true, false), Recorded(jittery, true));
}

// The duty that holds a current makes up for a late edge: 2 U late / T less voltage is commanded.
TEST(AmplifierErrors, TheCurrentLoopMakesUpForALateEdge) {
  RigParameters rig = BaseRig();
  rig.amplifier.edge_spread = 5e-7;
  const double T = 1 / rig.amplifier.switching_frequency;
  Plant plant = BuildPlant(TrueRig(rig));
  DrawCoilSpread(rig, &plant);
  const Scenario s = Undisturbed(rig, 0.05, false);
  const EngineOptions o;
  const Record with = SwitchingEngine(rig, s, o).Run().record;
  const Record without = SwitchingEngine(BaseRig(), s, o).Run().record;
  for (int j = 0; j < 8; ++j) {
    const std::string duty = "A.d" + std::to_string(j + 1);
    EXPECT_NEAR(with.Find(duty)->samples.back() - without.Find(duty)->samples.back(),
                -plant.bearings[0].bridge[static_cast<std::size_t>(j)].late_edge / T, 2e-4)
        << duty;
  }
}

// What is known of a bearing's coils is not drawn; the other bearings draw what they drew.
TEST(CoilSpread, IsNotDrawnWhereTheErrorsAreKnown) {
  RigParameters rig = Imperfect();
  Plant drawn = BuildPlant(TrueRig(rig));
  DrawCoilSpread(rig, &drawn);
  rig.bearings[0].coil_errors.current_gain = {0.01, 0, 0, 0, 0, 0, 0, -0.02};
  Plant plant = BuildPlant(TrueRig(rig));
  EXPECT_EQ(plant.bearings[0].current_sensor[0].gain, 1.01);
  EXPECT_EQ(plant.bearings[0].current_sensor[7].gain, 0.98);
  DrawCoilSpread(rig, &plant);
  EXPECT_EQ(plant.bearings[0].current_sensor[7].gain, 0.98);
  for (std::size_t j = 0; j < 8; ++j) {
    EXPECT_EQ(plant.bearings[0].bridge[j].late_edge, drawn.bearings[0].bridge[j].late_edge);
    EXPECT_EQ(plant.bearings[1].current_sensor[j].gain, drawn.bearings[1].current_sensor[j].gain);
  }
}

// A run of the machine whose errors are written down is the run of the machine that drew them.
TEST(CoilSpread, AsKnownErrorsGivesTheSameRun) {
  const RigParameters rig = Imperfect();
  Plant plant = BuildPlant(TrueRig(rig));
  DrawCoilSpread(rig, &plant);
  RigParameters known = rig;
  for (std::size_t k = 0; k < rig.bearings.size(); ++k)
    for (std::size_t j = 0; j < static_cast<std::size_t>(rig.bearings[k].coils()); ++j) {
      known.bearings[k].coil_errors.current_gain.push_back(
          plant.bearings[k].current_sensor[j].gain - 1);
      known.bearings[k].coil_errors.edge.push_back(plant.bearings[k].bridge[j].late_edge);
    }
  const Record a = Recorded(rig, false), b = Recorded(known, false, false);
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c)
    for (std::size_t k = 0; k < a.channels[c].samples.size(); ++k)
      ASSERT_NEAR(a.channels[c].samples[k], b.channels[c].samples[k],
                  1e-9 * (1 + std::abs(a.channels[c].samples[k])))
          << a.channels[c].name;
}

// The controller is not told.
TEST(CoilSpread, ThatIsKnownIsNothingOfTheNominalRig) {
  RigParameters rig = Imperfect();
  rig.bearings[0].coil_errors.edge.assign(8, 1e-8);
  EXPECT_FALSE(NominalRig(rig)->bearings[0].coil_errors.any());
}

TEST(CoilSpread, HasItsStandardDeviationAndIsOfTheUnit) {
  const RigParameters base = Imperfect();
  const auto drawn = [&](double unit) {
    RigParameters rig = base;
    rig.amplifier.unit = unit;
    Plant plant = BuildPlant(TrueRig(rig));
    plant.bearings[0].current_sensor[2].gain = 0.9;  // an effect's
    DrawCoilSpread(rig, &plant);
    return plant;
  };
  double gains = 0, edges = 0, both = 0;
  int coils = 0;
  for (int unit = 1; unit <= 200; ++unit)
    for (const BearingPlant& b : drawn(unit).bearings)
      for (std::size_t j = 0; j < static_cast<std::size_t>(b.lanes.coils); ++j, ++coils) {
        const bool changed = b.name == "A" && j == 2;
        const double gain = (b.current_sensor[j].gain / (changed ? 0.9 : 1) - 1) / kGainSpread,
                     edge = b.bridge[j].late_edge / kEdgeSpread;
        gains += gain * gain;
        edges += edge * edge;
        both += gain * edge;
      }
  const double within = 4 * std::sqrt(2.0 / coils);
  EXPECT_EQ(coils, 3200);
  EXPECT_NEAR(gains / coils, 1, within);
  EXPECT_NEAR(edges / coils, 1, within);
  EXPECT_NEAR(both / coils, 0, within);
  EXPECT_EQ(drawn(5).bearings[1].current_sensor[4].gain,
            drawn(5).bearings[1].current_sensor[4].gain);
  EXPECT_NE(drawn(5).bearings[1].current_sensor[4].gain,
            drawn(6).bearings[1].current_sensor[4].gain);
}

}  // namespace
}  // namespace ambrig
