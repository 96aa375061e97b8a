/// Averaged bridges against the switching rig's cycle means, and the equilibrium.
#include "simulation/continuous/averaged_engine.h"

#include <gtest/gtest.h>

#include "simulation/simulate.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

// f_A + f_B = m g, moments balance, by the closed form of the stator (not by the network that the
// solver used).
TEST(Equilibrium, MagnetsCarryTheWeight) {
  const RigParameters rig = BaseRig();
  SampledDataLoop sampled(rig, BaseScenario("steps", rig), {});
  const Equilibrium e = LevitatedEquilibrium(sampled.rig, sampled.plant, sampled.control);
  ASSERT_TRUE(e.usable()) << e.message;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), moment = sum;
  for (std::size_t k = 0; k < 2; ++k) {
    CoilVector i;
    for (int j = 0; j < kPoles; ++j) i[j] = e.current[k][j];
    const double z = rig.bearings[k].z;
    const Eigen::Vector2d r(e.q[0] + z * e.q[4], e.q[1] - z * e.q[3]);
    EXPECT_LT(r.norm(), 1e-13);  // the sensors' straight line through zero is the axis
    const Eigen::Vector2d f = RadialStator(rig.bearings[k].radial).Force(r, i);
    sum += f;
    moment += z * f;
  }
  const double weight = rig.rotor.mass * 9.81;
  EXPECT_NEAR(sum.y(), weight, 1e-7 * weight);
  EXPECT_NEAR(sum.x(), 0, 1e-7 * weight);
  EXPECT_NEAR(moment.norm(), 0, 1e-7 * weight);
}

// A magnetic centre beside the sensor's zero: the forces that the axes must ask for change, the
// balance holds. For small offsets the stator pulls with ks = -4 mu0 N² A c0² (1 + ...)/g0³ per
// axis.
TEST(Equilibrium, FindsTheForcesOfAnOffsetMagnet) {
  const RigParameters rig = BaseRig();
  SampledDataLoop sampled(rig, BaseScenario("steps", rig), {});
  const Equilibrium centred = LevitatedEquilibrium(sampled.rig, sampled.plant, sampled.control);
  sampled.plant.bearings[0].offset_x = 1e-6;  // the shaft sits 1 um towards -x of the magnet
  const Equilibrium e = LevitatedEquilibrium(sampled.rig, sampled.plant, sampled.control);
  ASSERT_TRUE(e.usable()) << e.message;
  const RadialStatorParameters& p = rig.bearings[0].radial;
  const double c0 = rig.controller.bias_current;
  // By the closed form: force at -1 um with the centred currents, which the axis must make up for.
  CoilVector i;
  for (int j = 0; j < kPoles; ++j) i[j] = centred.current[0][j];
  const double pull = RadialStator(p).Force({-1e-6, 0}, i).x();
  EXPECT_NEAR(pull,
              -1e-6 * 4 * kMu0 * p.turns * p.turns * p.pole_area * c0 * c0 / std::pow(p.gap, 3),
              0.2 * std::abs(pull));
  EXPECT_NEAR(e.force[0] - centred.force[0], -pull, 0.01 * std::abs(pull));
}

/// Ripple of one coil p-p at duty near one half, all coils switching together: the flux-carrying
/// patterns see N² mu0 A/g0 + L_l.
double Ripple(const RigParameters& rig) {
  const RadialStatorParameters& p = rig.bearings[0].radial;
  const double L = p.turns * p.turns * kMu0 * p.pole_area / p.gap + p.leakage_inductance;
  return rig.amplifier.bus_voltage * 0.5 / rig.amplifier.switching_frequency / L;
}

// Steps and loads on a levitated rotor. What averaging leaves out: the force of ripple², of
// relative size (ripple/i)²/12, which the position loop answers, and the start of a step inside a
// period. Both stay below a few percent of the ripple in current and a thousandth of the clearance
// in position.
TEST(AveragedEngine, CycleMeansOfTheSwitchingRig) {
  const RigParameters rig = BaseRig();
  Scenario scenario = BaseScenario("steps", rig);
  scenario.duration = 0.2;
  const Record fast = SwitchingEngine(rig, scenario, {}).Run().record;
  const Difference d = Compare(RunAveraged(rig, scenario).record, fast);
  EXPECT_LT(d.current, 0.05 * Ripple(rig)) << "ripple " << Ripple(rig);
  EXPECT_LT(d.current_rms, 0.002 * Ripple(rig));
  EXPECT_LT(d.position, 1e-3 * 2e-4);
}

// Clamped ramps run coils down to nothing, where the current flows for a part of the period only:
// there the error may reach the ripple, and no more.
TEST(AveragedEngine, DiscontinuousCurrentsErrByAtMostTheRipple) {
  const RigParameters rig = BaseRig();
  Scenario scenario = BaseScenario("clamped-ramps", rig);
  scenario.duration = 0.06;
  const Record fast = SwitchingEngine(rig, scenario, {}).Run().record,
               averaged = RunAveraged(rig, scenario).record;
  const Difference d = Compare(averaged, fast);
  EXPECT_LT(d.current, Ripple(rig));
  for (const Channel& c : averaged.channels) {
    if (c.unit != "A") continue;
    for (double i : c.samples) ASSERT_GE(i, -1e-9) << c.name;  // the diodes
  }
}

// Lift-off leaves its bearings and ends at the same place as the switching rig.
TEST(AveragedEngine, LiftOff) {
  const RigParameters rig = BaseRig();
  const Scenario scenario = BaseScenario("lift-off", rig);
  const RunResult averaged = RunAveraged(rig, scenario),
                  fast = SwitchingEngine(rig, scenario, {}).Run();
  EXPECT_FALSE(averaged.drop);
  for (const char* name : {"A.r.x", "A.r.y", "B.r.x", "B.r.y"})
    EXPECT_NEAR(averaged.record.Find(name)->samples.back(), fast.record.Find(name)->samples.back(),
                1e-7)
        << name;
  EXPECT_NEAR(averaged.metrics.copper_loss, fast.metrics.copper_loss,
              0.02 * fast.metrics.copper_loss);
}

TEST(AveragedEngine, BurstsAreRefused) {
  const RigParameters rig = BaseRig();
  EXPECT_THROW(RunAveraged(rig, BaseScenario("coil-burst", rig)), InputError);
}

}  // namespace
}  // namespace ambrig
