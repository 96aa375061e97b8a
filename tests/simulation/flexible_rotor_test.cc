/// Beam rotors in the rig: the TUM MBTR (examples/tum_mbtr) and what follows from it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/base/read_file.h"
#include "core/math/constants.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "rotor/motion/linearise.h"
#include "rotor/shaft/rotor_modes.h"
#include "simulation/continuous/averaged_engine.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/tum_rig.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

using testing::kTumFolder;
using testing::Mbtr;
using testing::Quiet;
using testing::Replaced;
using testing::TumRig;
using testing::TumRigText;

/// Without unbalance and losses, floating freely, nothing to touch.
RigParameters FreeShaft(double damping = 0, int modes = 4) {
  std::string text =
      Replaced(TumRigText(), "modal_damping = 0.002", fmt::format("modal_damping = {}", damping));
  text = Replaced(text, "modes = 4", fmt::format("modes = {}", modes));
  while (text.find("damping_stiffness = 5e-7") != std::string::npos)
    text = Replaced(text, "damping_stiffness = 5e-7", "");
  RigParameters rig = TumRig(text);
  rig.effects.clear();
  rig.gravity = {0, 0, 0};
  for (BearingParameters& b : rig.bearings) b.auxiliary.reset();
  return rig;
}

TEST(FlexibleRotor, InlineAndInAFileAreOneRig) {
  const RigParameters file = Mbtr(), text = TumRig(TumRigText());
  EXPECT_EQ(file.rotor.mass, text.rotor.mass);
  ASSERT_EQ(file.modes.size(), 4u);
  ASSERT_EQ(text.modes.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(file.modes[k].omega, text.modes[k].omega);
  EXPECT_NEAR(file.rotor.mass, 3.2731, 5e-5);  // published rows: docs/theory/rotor.md
  EXPECT_NEAR(file.z_origin, 0.36460, 5e-6);
  EXPECT_NEAR(file.bearings[0].z, 0.113 - file.z_origin, 1e-15);
  EXPECT_NEAR(file.modes[0].omega / (2 * kPi), 22.378, 1e-3);
}

// Without modes the beam is the rigid rotor of its mass and inertia, along its own axis.
TEST(FlexibleRotor, WithoutModesItIsTheRigidRotor) {
  const RigParameters beam = TumRig(Replaced(TumRigText(), "modes = 4", "modes = 0"));
  EXPECT_TRUE(beam.modes.empty());
  std::string text = ReadFile(kTumFolder + "rig.toml");
  text = Replaced(
      text, "kind = \"beam\"\nfile = \"shaft.toml\"\n",
      fmt::format("kind = \"rigid\"\nmass = {}\ninertia_transverse = {}\ninertia_polar = {}\n",
                  beam.rotor.mass, beam.rotor.inertia_transverse, beam.rotor.inertia_polar));
  text = Replaced(text, "modal_damping = 0.002", "");
  for (const char* z : {"0.113", "0.623"})
    for (int twice = 0; twice < 2; ++twice)
      text = Replaced(text, fmt::format("z = {}", z),
                      fmt::format("z = {}", std::stod(z) - beam.z_origin));
  text = text.substr(0, text.find("[[effect]]"));  // a rigid rotor has no disk to put it on
  RigParameters without = beam;
  without.effects.clear();
  const RigParameters rigid = TumRig(text);
  EngineOptions o;
  o.warm_up = 0.01;
  const Record a = SwitchingEngine(without, Quiet(without, 0.05, 300), o).Run().record;
  const Record b = SwitchingEngine(rigid, Quiet(rigid, 0.05, 300), o).Run().record;
  for (const char* name : {"A.r.x", "A.r.y", "B.r.y", "A.i1", "B.i5"}) {
    const auto &x = a.Find(name)->samples, &y = b.Find(name)->samples;
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_EQ(x[k], y[k]) << name << " row " << k;
  }
}

// Free decay of each mode against eta = e^{-zeta w t} (cos wd t + zeta/√(1-zeta²) sin wd t).
TEST(FlexibleRotor, AModeRingsDownAtItsFrequencyAndDamping) {
  const double zeta = 0.004;
  const Plant plant = BuildPlant(TrueRig(FreeShaft(zeta)));
  for (std::size_t k = 0; k < 4; ++k) {
    const double w = plant.rotor.modes()[k].omega, wd = w * std::sqrt(1 - zeta * zeta);
    const auto d = static_cast<std::size_t>(plant.rotor.mode_dof(k));
    MotionState s;
    s.q[d] = 1e-5;
    double worst = 0;
    for (int n = 1; n <= 10000; ++n) {  // 0.4 s
      plant.rotor.Step(s, DofVector{}, 0, 0, 4e-5);
      const double t = n * 4e-5;
      const double eta = std::exp(-zeta * w * t) *
                         (std::cos(wd * t) + zeta / std::sqrt(1 - zeta * zeta) * std::sin(wd * t));
      worst = std::max(worst, std::abs(s.q[d] / 1e-5 - eta));
    }
    // Runge-Kutta's phase: (wh)^4/120 of the angle turned, 535 rad and w h = 0.0535 for the last.
    EXPECT_LT(worst, 2 * std::pow(w * 4e-5, 4) / 120 * w * 0.4 + 1e-12) << "mode " << k + 1;
  }
}

// Nothing dissipates: energy stays while the gyroscopic coupling of a fast rotor mixes everything.
TEST(FlexibleRotor, KeepsItsEnergyAtSpeed) {
  const Plant plant = BuildPlant(TrueRig(FreeShaft()));
  MotionState s;
  s.Omega = 500;
  RotorModel& rotor = const_cast<RotorModel&>(plant.rotor);
  rotor.SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, 500.0}}));
  for (int d = 3; d < rotor.dof(); ++d) s.v[static_cast<std::size_t>(d)] = 0.01 * (d % 3 + 1);
  rotor.SetSpin(s);
  const double spin = 0.5 * rotor.parameters().inertia_polar * s.Omega * s.Omega,
               before = rotor.Energy(s) - spin;
  for (int n = 0; n < 5000; ++n) rotor.Step(s, DofVector{}, 0, 0, 4e-5);
  // Steps turn the fastest whirl by 0.1 rad at most: |R|² = 1 - (wh)^6/72 each.
  EXPECT_NEAR((rotor.Energy(s) - spin) / before, 1, 5000 * std::pow(0.1, 6) / 72);
  EXPECT_GT(std::abs(s.q[4]), 1e-6);  // the tilt has taken part
}

std::vector<WhirlMode> Bending(const LinearRotor& linear, double speed, std::size_t count) {
  std::vector<WhirlMode> out;
  for (const WhirlMode& m : WhirlModes(linear, speed, 30))
    if (m.omega_d > 2 * kPi * 15 && out.size() < count) out.push_back(m);
  return out;
}

// At speed the reduced rotor splits forward and backward as the whole beam does; gyroscopic moments
// of the modes left out are what is missing.
TEST(FlexibleRotor, SplitsLikeTheBeam) {
  const RigParameters rig = FreeShaft(0, 8);
  const Plant plant = BuildPlant(TrueRig(rig));
  BeamDefinition d = rig.beam->definition;
  const LinearRotor full = Assemble(BuildBeam(d));
  for (double speed : {100.0, 314.159, 1000.0}) {
    LinearRotor linear = LinearRotorOf(plant, speed);
    // Without z, which is no part of bending.
    const Eigen::Index n = linear.M.rows();
    std::vector<int> keep;
    for (int i = 0; i < n; ++i)
      if (i != 2) keep.push_back(i);
    LinearRotor radial;
    radial.M = linear.M(keep, keep), radial.G = linear.G(keep, keep);
    radial.D = linear.D(keep, keep), radial.K = linear.K(keep, keep);
    for (const auto& [x, y] : linear.xy)
      radial.xy.push_back({x > 2 ? x - 1 : x, y > 2 ? y - 1 : y});
    const auto ours = Bending(radial, speed, 6), theirs = Bending(full, speed, 6);
    ASSERT_EQ(ours.size(), theirs.size());
    for (std::size_t k = 0; k < ours.size(); ++k) {
      EXPECT_NEAR(ours[k].omega_d / theirs[k].omega_d, 1, 2e-3) << "mode " << k << " at " << speed;
      if (std::abs(theirs[k].whirl) > 0.5) {
        EXPECT_EQ(ours[k].sense(), theirs[k].sense()) << "mode " << k << " at " << speed;
      }
    }
  }
}

// The nonlinear model moves as its linear equations say: one whirl mode followed over ten turns.
TEST(FlexibleRotor, WhirlsAsItsEigenvector) {
  const double speed = 314.159;
  const Plant plant = BuildPlant(TrueRig(FreeShaft(0.003)));
  RotorModel& rotor = const_cast<RotorModel&>(plant.rotor);
  rotor.SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, speed}}));
  const LinearRotor linear = LinearRotorOf(plant, speed);
  for (const WhirlMode& mode : WhirlModes(linear, speed, 40)) {
    if (mode.omega_d < 2 * kPi * 20) continue;
    const double scale = 1e-5 / mode.shape.cwiseAbs().maxCoeff();
    MotionState s;
    rotor.SetSpin(s);
    const auto at = [&](double t, int d) { return scale * (mode.shape(d) * std::exp(mode.s * t)); };
    for (int d = 0; d < rotor.dof(); ++d) {
      s.q[static_cast<std::size_t>(d)] = at(0, d).real();
      s.v[static_cast<std::size_t>(d)] = (mode.s * at(0, d)).real();
    }
    const int steps = static_cast<int>(10 * 2 * kPi / mode.omega_d / 4e-5);
    for (int n = 0; n < steps; ++n) rotor.Step(s, DofVector{}, 0, 0, 4e-5);
    for (int d = 0; d < rotor.dof(); ++d)
      EXPECT_NEAR(s.q[static_cast<std::size_t>(d)], at(steps * 4e-5, d).real(), 1e-9)
          << "coordinate " << d << " of " << mode.omega_d / (2 * kPi) << " Hz";
  }
}

/// Response at the disk to a force there, shaft on springs at the bearings, by n modes.
std::complex<double> Compliance(int modes, double w) {
  const RigParameters rig =
      TumRig(Replaced(TumRigText(), "modes = 4", fmt::format("modes = {}", modes)));
  const Plant plant = BuildPlant(TrueRig(rig));
  const LinearRotor linear = LinearRotorOf(plant);
  Eigen::MatrixXcd Z = (linear.K - w * w * linear.M).cast<std::complex<double>>();
  for (const LinearPort& p : linear.ports)
    Z += (p.B * (1.5e5 + std::complex<double>(0, w * 250)) * p.gap);
  const Eigen::MatrixXd disk = PlaneRows(plant.rotor, plant.stations[1].second);
  const Eigen::VectorXcd q =
      Z.partialPivLu().solve(disk.transpose().col(0).cast<std::complex<double>>());
  return (disk.cast<std::complex<double>>() * q)(0);
}

TEST(FlexibleRotor, ConvergesWithTheModesKept) {
  const double w = 2 * kPi * 30;
  BeamDefinition d = Mbtr().beam->definition;
  d.supports = {IsotropicSupport(0.113, 1.5e5, 250), IsotropicSupport(0.623, 1.5e5, 250)};
  for (ShaftSection& s : d.sections) s.damping_stiffness = 0;
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor full = Assemble(beam);
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(full.M.rows());
  const int x = full.xy[static_cast<std::size_t>(NodeAt(beam, 0.363))][0];
  f(x) = 1;
  const Eigen::MatrixXcd Z = (full.K - w * w * full.M).cast<std::complex<double>>() +
                             std::complex<double>(0, w) * full.D.cast<std::complex<double>>();
  const std::complex<double> exact = Z.partialPivLu().solve(f)(x);
  double before = 1e9;
  for (int n : {0, 1, 4, 8}) {
    const double error = std::abs(Compliance(n, w) - exact) / std::abs(exact);
    EXPECT_LT(error, before) << n << " modes";
    before = error;
  }
  EXPECT_LT(before, 1e-3);
}

TEST(FlexibleRotor, RestsInEquilibriumOnItsAuxiliaryBearings) {
  RigParameters rig = Mbtr();
  rig.effects.clear();
  const Plant plant = BuildPlant(TrueRig(rig));
  MotionState s;
  plant.rotor.Rest(s);
  DofVector a{};
  double torque = 0;
  plant.rotor.Accelerations(s, DofVector{}, 0, 0, a, &torque);
  for (int d = 0; d < plant.rotor.dof(); ++d)
    EXPECT_NEAR(a[static_cast<std::size_t>(d)], 0, 1e-6) << "coordinate " << d;
  EXPECT_LT(s.q[static_cast<std::size_t>(plant.rotor.mode_dof(0)) + 1], -1e-5);
}

TEST(FlexibleRotor, SensorsReadTheBentShaftAtTheirOwnPlane) {
  RigParameters rig = FreeShaft();
  rig = TumRig(Replaced(TumRigText(), "sensor = { z = 0.113", "sensor = { z = 0.155"));
  const Plant plant = BuildPlant(TrueRig(rig));
  const ReducedRotor reduced = BuildReduced(*rig.beam);
  MotionState s;
  for (std::size_t k = 0; k < 4; ++k) s.q[static_cast<std::size_t>(plant.rotor.mode_dof(k))] = 1e-3;
  const ModalStation at = StationAt(reduced, 0.155), magnet = StationAt(reduced, 0.113);
  EXPECT_NEAR(plant.bearings[0].sensor.map.X(s.q), 1e-3 * at.phi.sum(), 1e-12);
  EXPECT_NEAR(plant.bearings[0].plane.X(s.q), 1e-3 * magnet.phi.sum(), 1e-12);
  const ModalStation between = StationAt(reduced, 0.2171);  // inside an element
  EXPECT_NEAR(plant.rotor.MakePlane(0.2171 - rig.z_origin).X(s.q), 1e-3 * between.phi.sum(), 1e-12);
}

}  // namespace
}  // namespace ambrig
