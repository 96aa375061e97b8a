// Effects of coils, amplifiers and current measurement, each against a closed form.
#include <gtest/gtest.h>

#include "effects/coil_targets.h"
#include "tests/effects/effect_rigs.h"
#include "tests/rig/exact_coils.h"

namespace ambrig {
namespace {

/// Force of bearing A along x with a difference current in the coils, shaft at x [N].
double ForceX(Plant& plant, double bias, double difference, double x) {
  BearingPlant& b = plant.bearings[0];
  Lane i;
  for (int j = 0; j < kLanes; ++j) i[j] = bias + difference * b.lanes.direction_x[j];
  const double at = x - b.offset_x;
  b.lanes.Settle(i, at, 0);
  double fx, fy;
  b.lanes.Force(at, 0, &fx, &fy);
  return fx;
}

struct Stiffness {
  double ki, ks;
};

Stiffness StiffnessOf(Plant& plant, double bias) {
  const double di = 1e-4 * bias, dx = 1e-8;  // truncation: (dx/g0)² = 1e-9
  return {(ForceX(plant, bias, di, 0) - ForceX(plant, bias, -di, 0)) / (2 * di),
          (ForceX(plant, bias, 0, dx) - ForceX(plant, bias, 0, -dx)) / (2 * dx)};
}

// published_values.md 7: iron path p per gap: B and dB/dx as with g_eff = g0 + p,
// so ki/ks = g_eff/i0.
TEST(IronReluctance, StiffnessRatioIsTheEffectiveGapOverTheBias) {
  const RigParameters rig = ReferenceRig();
  const double g0 = rig.bearings[0].radial.gap, path = 30e-6, bias = 2;
  Plant with = PlantWith("iron-reluctance", "A", {{"path", path}}),
        without = BuildPlant(TrueRig(rig));
  const Stiffness iron = StiffnessOf(with, bias), ideal = StiffnessOf(without, bias);
  EXPECT_NEAR(ideal.ki / ideal.ks, g0 / bias, 1e-6 * g0);
  EXPECT_NEAR(iron.ki / iron.ks, (g0 + path) / bias, 1e-6 * g0);
  EXPECT_NEAR(iron.ki / ideal.ki, std::pow(g0 / (g0 + path), 2), 1e-6);
  EXPECT_NEAR(iron.ks / ideal.ks, std::pow(g0 / (g0 + path), 3), 1e-6);
}

// Far below 0.2 T the threshold is a path of mu0 threshold/0.2 T; at 0.2 T it takes half its MMF.
TEST(IronReluctance, ThresholdIsAPathAtLowFluxAndHalfItsMmfAtItsDensity) {
  const double threshold = 4, low = 1e-3;
  Plant with = PlantWith("iron-reluctance", "A", {{"threshold", threshold}}),
        path = PlantWith("iron-reluctance", "A", {{"path", kMu0 * threshold / 0.2}}),
        ideal = BuildPlant(TrueRig(ReferenceRig()));
  EXPECT_NEAR(RestFlux(with, Currents(low))[0] / RestFlux(path, Currents(low))[0], 1, 1e-3);
  // the current that raises the flux of ideal iron by the MMF that iron takes at that flux
  const BearingParameters b = ReferenceRig().bearings[0];
  const double at = 0.2 * b.radial.gap / kMu0, turns = b.radial.turns;
  EXPECT_NEAR(RestFlux(with, Currents((at + threshold / 2) / turns))[0] /
                  RestFlux(ideal, Currents(at / turns))[0],
              1, 1e-6);
}

// Pull = (1/2) phi² dR/dg with R = g / (mu0 A (1 + c g/g0)): the force at the centre is
// (1 + c)² (1 + c)^-2 of that of ideal iron at equal currents, that is the same, while L grows by
// 1 + c.
TEST(Fringing, InductanceGrowsForceAtTheCentreDoesNot) {
  const double c = 0.12;
  Plant with = PlantWith("fringing", "A", {{"coefficient", c}}),
        without = BuildPlant(TrueRig(ReferenceRig()));
  EXPECT_NEAR(RestFlux(with, Currents(2))[0] / RestFlux(without, Currents(2))[0], 1 + c, 1e-12);
  EXPECT_NEAR(StiffnessOf(with, 2).ki / StiffnessOf(without, 2).ki, 1, 1e-6);
  // ks: the same pull 1/g² in place of (1/g²): f = mu0 A (N i)²/(2 g²) whatever c.
  EXPECT_LT(StiffnessOf(with, 2).ks, 1.001 * StiffnessOf(without, 2).ks);
}

// Pull = phi²/(2 mu0 A) of all flux: at equal currents the flux is 1 + c times that of ideal iron,
// the force (1 + c)² times; half and half with virtual work, whose force is 1 times, the mean of
// both.
TEST(Fringing, FluxThatPullsLikeTheFaceAddsToTheForceTwice) {
  const double c = 0.12;
  Plant face = PlantWith("fringing", "A", {{"coefficient", c}, {"face_pull", 1.0}}),
        half = PlantWith("fringing", "A", {{"coefficient", c}, {"face_pull", 0.5}}),
        without = BuildPlant(TrueRig(ReferenceRig()));
  EXPECT_NEAR(RestFlux(face, Currents(2))[0] / RestFlux(without, Currents(2))[0], 1 + c, 1e-12);
  const double ki = StiffnessOf(without, 2).ki;
  EXPECT_NEAR(StiffnessOf(face, 2).ki / ki, std::pow(1 + c, 2), 1e-6);
  EXPECT_NEAR(StiffnessOf(half, 2).ki / ki, 0.5 * (1 + std::pow(1 + c, 2)), 1e-6);
}

TEST(MagneticOffset, ForceAtZeroIsStiffnessTimesOffset) {
  const double dx = 1e-6, bias = 2;
  Plant with = PlantWith("magnetic-offset", "A", {{"dx", dx}}),
        without = BuildPlant(TrueRig(ReferenceRig()));
  const Stiffness s = StiffnessOf(without, bias);
  // Cubic term of the force: (dx/g0)² relative.
  EXPECT_NEAR(ForceX(with, bias, 0, 0), -s.ks * dx, 1e-4 * s.ks * dx);
  EXPECT_NEAR(ForceX(with, bias, bias * dx / ReferenceRig().bearings[0].radial.gap, 0), 0,
              1e-4 * s.ks * dx);
}

TEST(TurnMismatch, ScalesMmfResistanceAndLeakage) {
  Plant with = PlantWith("turn-mismatch", "A.coil3", {{"ratio", 0.9}}),
        without = BuildPlant(TrueRig(ReferenceRig()));
  const StatorLanes &a = with.bearings[0].lanes, &b = without.bearings[0].lanes;
  EXPECT_DOUBLE_EQ(a.n[2], 0.9 * b.n[2]);
  EXPECT_DOUBLE_EQ(a.resistance[2], 0.9 * b.resistance[2]);
  EXPECT_DOUBLE_EQ(with.bearings[0].base_resistance[2], 0.9 * b.resistance[2]);
  EXPECT_DOUBLE_EQ(a.leakage[2], 0.81 * b.leakage[2]);
  EXPECT_EQ(a.n[3], b.n[3]);
  EXPECT_EQ(with.bearings[1].lanes.n[2], without.bearings[1].lanes.n[2]);
}

// Plugs and switches stand in series with the winding; a drawing may count more than is there, but
// no coil has less than nothing.
TEST(AmplifierOffset, AddsAResistanceToItsCoil) {
  const Plant with = PlantWith("amplifier-offset", "A.coil3", {{"resistance", -0.1}}),
              none = PlantWith("amplifier-offset", "A.coil3", {{"resistance", -9}}),
              without = BuildPlant(TrueRig(ReferenceRig()));
  const StatorLanes &a = with.bearings[0].lanes, &b = without.bearings[0].lanes;
  EXPECT_DOUBLE_EQ(a.resistance[2], b.resistance[2] - 0.1);
  EXPECT_DOUBLE_EQ(with.bearings[0].base_resistance[2], b.resistance[2] - 0.1);
  EXPECT_EQ(a.resistance[3], b.resistance[3]);
  EXPECT_GT(none.bearings[0].lanes.resistance[2], 0);
}

/// Change of the mean duty per volt of mean coil voltage, bi-state bridge [1/V].
double DutyPerVolt(const RigParameters& rig) {
  const AmplifierParameters& a = rig.amplifier;
  return 1 / (2 * a.bus_voltage + 2 * (a.diode_drop - a.switch_drop));
}

// The loop holds the reading at 3 A: a gain g leaves 3/g in the coil, an offset o leaves 3 - o. The
// record's reading does not show it, the duty does: it carries R times the true current.
TEST(CurrentSensor, LoopDrivesTheTrueCurrentAwayFromTheReading) {
  const std::string text = ClampedText(3, 0.05);
  const RigParameters rig = ReferenceRig();
  const RunResult plain = RunText(rig, text);
  const double lsb = 2 * rig.amplifier.adc_range / std::exp2(rig.amplifier.adc_bits);
  const auto check = [&](const std::string& id, const Values& v, double true_current) {
    const RunResult r = RunText(WithEffect(rig, id, "A.coil1", v), text);
    EXPECT_NEAR(TailMean(r.record, "A.i1", 250), TailMean(plain.record, "A.i1", 250), lsb) << id;
    const double wanted = rig.bearings[0].radial.resistance * (true_current - 3) * DutyPerVolt(rig);
    EXPECT_NEAR(TailMean(r.record, "A.d1", 250) - TailMean(plain.record, "A.d1", 250), wanted,
                0.05 * std::abs(wanted))
        << id;
  };
  check("current-sensor-gain", {{"gain", 1.1}}, 3 / 1.1);
  check("current-sensor-offset", {{"offset", 0.2}}, 2.8);
}

TEST(CurrentSensor, GainAndOffsetReachTheirCoilsOnly) {
  const Plant gain = PlantWith("current-sensor-gain", "A.coil2", {{"gain", 1.1}});
  const Plant offset = PlantWith("current-sensor-offset", "B", {{"offset", -0.05}});
  for (std::size_t j = 0; j < kLanes; ++j) {
    EXPECT_EQ(gain.bearings[0].current_sensor[j].gain, j == 1 ? 1.1 : 1.0);
    EXPECT_EQ(gain.bearings[1].current_sensor[j].gain, 1.0);
    EXPECT_EQ(offset.bearings[1].current_sensor[j].offset, -0.05);
    EXPECT_EQ(offset.bearings[0].current_sensor[j].offset, 0.0);
  }
}

// The on-phase is shorter by t_d: the loop gives back the duty t_d f_sw.
TEST(DeadTime, LoopGivesTheDutyBack) {
  const double time = 1e-6;
  const RigParameters rig = ReferenceRig(),
                      with = WithEffect(rig, "dead-time", "rig", {{"time", time}});
  const std::string text = ClampedText(3, 0.05);
  const RunResult a = RunText(rig, text), b = RunText(with, text);
  EXPECT_NEAR(TailMean(b.record, "A.d1", 250) - TailMean(a.record, "A.d1", 250),
              time * rig.amplifier.switching_frequency, 5e-4);
}

// R = R20 (1 + 0.00393 dT); with a time constant far below the record dT settles at rise R i².
TEST(CopperHeating, DutyCarriesTheWarmResistance) {
  const double rise = 20, tau = 2e-3, high = 4;
  const RigParameters rig = WithExactCoils(ReferenceRig()),
                      with = WithEffect(rig, "copper-heating", "A",
                                        {{"rise_per_watt", rise}, {"time_constant", tau}});
  const std::string text = ClampedText(high, 0.08);
  const RunResult cold = RunText(rig, text), warm = RunText(with, text);
  const double r20 = rig.bearings[0].radial.resistance;
  const double r =
      r20 / (1 - 0.00393 * rise * r20 * high * high);  // dT = rise R i², R = R20 (1 + 0.00393 dT)
  const double dv = (r - r20) * high;
  const double wanted = dv * DutyPerVolt(rig);
  EXPECT_NEAR(TailMean(warm.record, "A.d1", 250) - TailMean(cold.record, "A.d1", 250), wanted,
              0.05 * wanted);
}

// Heat that is shared warms a coil beyond its own loss: with four coils at 4 A and four at 1 A the
// mean loss is 8.5 R A². dT settles at rise P, R = R20 (1 + 0.00393 dT).
TEST(CopperHeating, SharedHeatWarmsTheCoilsThatCarryLess) {
  const double rise = 30, tau = 2e-3;
  const RigParameters rig = ReferenceRig();
  std::string text = ClampedText(1, 0.08);
  for (int j = 1; j <= 4; ++j)
    text += "[[excitation]]\ntarget = \"A.coil" + std::to_string(j) +
            "\"\nport = \"current\"\nkind = \"step\"\nstart = 0.0\nstop = 0.08\namplitude = 3\n";
  const Record cold = RunText(rig, text).record;
  const double r20 = rig.bearings[0].radial.resistance;
  for (const double shared : {0.0, 0.5, 1.0}) {
    const Record warm =
        RunText(WithEffect(rig, "copper-heating", "A",
                           {{"rise_per_watt", rise}, {"time_constant", tau}, {"shared", shared}}),
                text)
            .record;
    double current[8], resistance[8];
    double mean = 0;
    for (int j = 0; j < 8; ++j) {
      const std::string n = std::to_string(j + 1);
      current[j] = TailMean(warm, "A.i" + n, 250);
      resistance[j] = r20 + (TailMean(warm, "A.d" + n, 250) - TailMean(cold, "A.d" + n, 250)) /
                                DutyPerVolt(rig) / current[j];
      mean += resistance[j] * current[j] * current[j] / 8;
    }
    for (int j = 0; j < 8; ++j) {
      const double loss = (1 - shared) * resistance[j] * current[j] * current[j] + shared * mean;
      EXPECT_NEAR(resistance[j] - r20, r20 * 0.00393 * rise * loss,
                  0.05 * r20 * 0.00393 * rise * loss + 2e-3)
          << "coil " << j + 1 << ", shared " << shared;
    }
  }
}

// A chopper without current loop: mean current = (d U - (1 - d) drop)/R.
TEST(Chopper, DropAndOffsetEnterTheMeanVoltage) {
  RigParameters rig = ReferenceRig();
  rig.amplifier.modulation = Modulation::kChopper;
  const auto at = [&](const std::string& id, const Values& v) {
    const Plant plant = BuildPlant(TrueRig(WithEffect(rig, id, "A.coil4", v)));
    const CoilVoltage c = plant.bridge.Pattern(0.4, plant.bearings[0].bridge[3]);
    const double T = 1 / rig.amplifier.switching_frequency, bus = rig.amplifier.bus_voltage;
    return ((c.gain[0] * bus + c.drop[0]) * c.t1 + (c.gain[1] * bus + c.drop[1]) * (c.t2 - c.t1) +
            (c.gain[2] * bus + c.drop[2]) * (T - c.t2)) /
           T;
  };
  const double bus = rig.amplifier.bus_voltage;
  EXPECT_NEAR(at("freewheel-drop", {{"drop", 0.8}}), 0.4 * bus - 0.6 * 0.8, 1e-9);
  EXPECT_NEAR(at("amplifier-offset", {{"offset", -0.5}}), 0.4 * (bus - 0.5), 1e-9);
  EXPECT_NEAR(at("amplifier-offset", {{"dead_duty", 0.45}}), 0, 1e-9);
}

TEST(LoopDelay, AnyPartOfAPeriodWaitsForTheNextPwmStart) {
  const RigParameters rig = ReferenceRig();
  const double T = 1 / rig.amplifier.switching_frequency;
  const auto record = [&](double time) {
    return RunText(WithEffect(rig, "loop-delay", "rig", {{"time", time}}), LevitatedText()).record;
  };
  const Record three_and_a_bit = record(3.2 * T), four = record(4 * T), five = record(5 * T);
  EXPECT_EQ(Change(three_and_a_bit, four), 0);
  EXPECT_GT(Change(four, five), 1e-3);
}

// Ideal iron on the general path is the fast path, up to how the gap is interpolated within a
// period.
TEST(GeneralPath, EqualsTheFastPathForIdealIron) {
  const RigParameters rig = ReferenceRig();
  const Scenario scenario = ReadScenarioText(LevitatedText(), "test.toml", rig);
  EngineOptions general;
  general.force_general_path = true;
  const Record fast = SwitchingEngine(rig, scenario, {}).Run().record;
  const Record slow = SwitchingEngine(rig, scenario, general).Run().record;
  EXPECT_LT(Change(fast, slow), 2e-3);  // an ADC step now and then: 10 mA of 18 samples
}

}  // namespace
}  // namespace ambrig
