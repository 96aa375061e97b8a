// A rig whose dropped bending modes leave their static compliance at the magnets:
// `static_correction` of [rotor].
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "analysis/dropped_modes.h"
#include "core/math/constants.h"
#include "rig/parameters/rig_rotor.h"
#include "rig/rig_assembly.h"
#include "rotor/linear/linear_rotor.h"
#include "rotor/shaft/rotor_modes.h"
#include "simulation/continuous/averaged_engine.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/tum_rig.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

using testing::Quiet;
using testing::TumRig;
using testing::TumRigText;

std::string Corrected(int modes) {
  return TumRigText(
      {{"modes = 4", "modes = " + std::to_string(modes) + "\nstatic_correction = true"}});
}

TEST(StaticCorrection, TheRigHasAResidualModeForEachBearing) {
  const RigParameters rig = TumRig(Corrected(2)), plain = testing::Mbtr();
  ASSERT_EQ(rig.modes.size(), 4U);
  EXPECT_EQ(rig.modes[1].omega, plain.modes[1].omega);
  EXPECT_EQ(rig.rotor.mass, plain.rotor.mass);
  EXPECT_EQ(rig.z_origin, plain.z_origin);
  EXPECT_EQ(ResidualPlanes(rig).size(), 2U);
  EXPECT_TRUE(ResidualPlanes(plain).empty());
}

// x at A's sensor for a force at A's magnet, on springs and dampers at the magnets, below the kept
// modes: the rig's linear model against the whole beam. What is left is of second order in what the
// kept modes alone miss.
std::complex<double> OfTheRig(const RigParameters& rig, double w) {
  const Plant plant = BuildPlant(TrueRig(rig));
  const LinearRotor linear = LinearRotorOf(plant);
  Eigen::MatrixXcd Z = (linear.K - w * w * linear.M).cast<std::complex<double>>();
  Z.diagonal()(2) = 1;  // z is free
  for (const LinearPort& p : linear.ports)
    Z += p.B * (4e6 + std::complex<double>(0, w * 250)) * p.gap;
  const Eigen::VectorXcd q =
      Z.partialPivLu().solve(linear.ports[0].B.col(0).cast<std::complex<double>>());
  return linear.ports[0].C.row(0).cast<std::complex<double>>() * q;
}
std::complex<double> OfTheBeam(const RigParameters& rig, double w) {
  BeamDefinition d = rig.beam->definition;
  d.supports = {IsotropicSupport(0.113, 4e6, 250), IsotropicSupport(0.623, 4e6, 250)};
  for (ShaftSection& s : d.sections) s.damping_stiffness = 0;
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor full = Assemble(beam);
  const Eigen::MatrixXcd Z = (full.K - w * w * full.M).cast<std::complex<double>>() +
                             std::complex<double>(0, w) * full.D.cast<std::complex<double>>();
  const Eigen::RowVectorXd row = ShaftRows(beam, 0.113).row(0);
  const Eigen::VectorXcd f = row.transpose().cast<std::complex<double>>();
  return row.cast<std::complex<double>>() * Z.partialPivLu().solve(f);
}

TEST(StaticCorrection, SensorsMoveAsOnTheWholeBeam) {
  const RigParameters with = TumRig(Corrected(2)),
                      without = TumRig(TumRigText({{"modes = 4", "modes = 2"}}));
  for (const double f : {10.0, 40.0, 80.0}) {
    const std::complex<double> exact = OfTheBeam(with, 2 * kPi * f);
    const double error = std::abs(OfTheRig(with, 2 * kPi * f) / exact - 1.0),
                 missed = std::abs(OfTheRig(without, 2 * kPi * f) / exact - 1.0);
    EXPECT_GT(missed, 1e-7) << f;
    EXPECT_LT(error, 10 * missed * missed) << f;
  }
}

// Gravity does not push free modes: what bends the shaft are the magnets' forces, so that a
// levitated run hangs as the whole beam does, with no bending mode kept at all. The bound is the
// controller's tremble, 0.2 um of 0.6 mm.
TEST(StaticCorrection, ALevitatedShaftHangsAsTheWholeBeam) {
  BeamDefinition d = testing::Mbtr().beam->definition;
  d.supports = {IsotropicSupport(0.113, 1e12, 0), IsotropicSupport(0.623, 1e12, 0)};
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor pinned = Assemble(beam);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(pinned.M.rows());
  for (const auto& xy : pinned.xy) g(xy[1]) = -9.81;
  const Eigen::VectorXd rest = pinned.K.llt().solve(pinned.M * g);
  const double sag = rest(pinned.xy[static_cast<std::size_t>(NodeAt(beam, 0.363))][1]);
  const double share = (0.363 - 0.113) / (0.623 - 0.113);
  const auto error = [&](const std::string& text) {
    RigParameters rig = TumRig(text);
    rig.effects.clear();
    const Record record = SwitchingEngine(rig, Quiet(rig, 0.06, 0), {}).Run().record;
    const auto last = [&](const char* name) { return record.Find(name)->samples.back(); };
    const double bent = last("disk.r.y") - (1 - share) * last("A.r.y") - share * last("B.r.y");
    return std::abs(bent / sag - 1);
  };
  EXPECT_GT(error(TumRigText({{"modes = 4", "modes = 0"}})), 0.9);
  EXPECT_GT(error(TumRigText({{"modes = 4", "modes = 1"}})), 1e-3);
  for (const int modes : {0, 1}) EXPECT_LT(error(Corrected(modes)), 3e-4) << modes;
}

TEST(StaticCorrection, TheRunSaysWhatCarriesTheCompliance) {
  const RigParameters with = TumRig(Corrected(2)),
                      without = TumRig(TumRigText({{"modes = 4", "modes = 2"}}));
  const DroppedModes a = *FindDroppedModes(with), b = *FindDroppedModes(without);
  EXPECT_EQ(a.kept, 2);
  EXPECT_EQ(a.dropped, b.dropped);
  EXPECT_EQ(a.top, b.top);
  ASSERT_EQ(a.residual.size(), 2U);
  EXPECT_TRUE(b.residual.empty());
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT(std::abs(a.bearings[k].lost), 1e-6 * std::abs(b.bearings[k].lost));
    EXPECT_NEAR(
        (a.bearings[k].kept + a.bearings[k].lost) / (b.bearings[k].kept + b.bearings[k].lost), 1,
        1e-9);
    EXPECT_LT(std::abs(a.bearings[k].lost_at_top), 0.2 * std::abs(b.bearings[k].lost_at_top));
  }
  EXPECT_NE(DroppedModesText(a).find("residual modes at"), std::string::npos);
}

// A blow to the disk of the turning, levitated rotor: the engines and SUNDIALS, one trajectory.
// Bounds as in tests/simulation/levitated_shaft_test.cc.
TEST(StaticCorrection, FidelitiesAgree) {
  const RigParameters rig = TumRig(Corrected(2));
  Scenario scenario = Quiet(rig, 0.02, 300);
  scenario.loads = {{rig.FindStation("disk")->z, false, 3, -6, 0, 0.002, 0.006}};
  const double warm_up = 0.01;
  ReferenceOptions r;
  r.sampled.warm_up = warm_up;
  const Record reference = RunReference(rig, scenario, r).record;
  EngineOptions o;
  o.warm_up = warm_up;
  const Difference fast = Compare(SwitchingEngine(rig, scenario, o).Run().record, reference);
  EXPECT_GT(fast.rows, 200u);
  EXPECT_LT(fast.position, 1e-7);
  EXPECT_LT(fast.current, 5e-3);
  AveragedOptions m = DefaultAveragedOptions();
  m.sampled.warm_up = warm_up;
  EXPECT_LT(Compare(RunAveraged(rig, scenario, m).record, reference).position, 2e-6);
}

TEST(StaticCorrection, TooManyModesAreOneLine) {
  try {
    TumRig(Corrected(8));
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("static_correction"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("allowed: 8 modes"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace ambrig
