/// The linear plant of a rig against its closed forms and against the nonlinear engines.
#include "analysis/linear/control_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "rig/rig_assembly.h"
#include "simulation/sampled/controller_setup.h"
#include "simulation/simulate.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

const std::vector<std::size_t> kRadial{0, 1, 2, 3};

// At rest a constant force command must carry: y = -f / ks of a rigid rotor held at the bearings
// (negative stiffness), so for a common shift y = f (m g = 0): the static gain is the inverse of
// the magnets' stiffness alone.
TEST(ControlPlant, StaticGainIsTheNegativeStiffness) {
  const RigParameters rig = RigWith("kind = \"pid\"\n" + kPidGains);
  const SampledPlant p = MakeControlPlant(rig, kRadial, 0);
  const Eigen::MatrixXd gain = p.FromForce().Response(1.0).real();
  // Both x axes with the same force, at the bearings' planes: shift and tilt of the readings; to
  // the bearings by the lever.
  const Eigen::VectorXd y = gain * Eigen::Vector4d(1, 0, 1, 0);
  const double zA = -0.12, zB = 0.13, sA = -0.135, sB = 0.145, slope = (y[2] - y[0]) / (sB - sA);
  // k c0²/g0 = 4 mu0 N² A c0²/g0³, weight left out
  const double ks = 8 * kMu0 * 50 * 50 * 2.0372e-4 * 4 / std::pow(4e-4, 3) * 0.5;
  // the weight adds some per cent
  for (const double z : {zA, zB}) EXPECT_NEAR(y[0] + slope * (z - sA), -1 / ks, 0.12 / ks) << z;
}

// Without delay the phase of latency is exact: doubling the controller period by hand changes
// nothing but the rate. What is exact: the free rotor's rigid body mode at high frequency, y = f/(m
// w²), times the current loop; below, the unstable pole sqrt(ks/m).
TEST(ControlPlant, UnstablePolesOfTheRigidRotor) {
  const RigParameters rig = RigWith("kind = \"pid\"\n" + kPidGains);
  const SampledPlant p = MakeControlPlant(rig, kRadial, 0);
  const Eigen::VectorXcd poles = p.A.eigenvalues();
  int unstable = 0;
  for (Eigen::Index k = 0; k < poles.size(); ++k) unstable += std::abs(poles[k]) > 1 + 1e-9 ? 1 : 0;
  EXPECT_EQ(unstable, 4);  // shift and tilt in both planes
}

std::complex<double> SineFit(const Record& r, const std::string& channel, double hertz,
                             double from) {
  const Channel* c = r.Find(channel);
  EXPECT_NE(c, nullptr);
  std::complex<double> sum = 0;
  double n = 0, mean = 0;
  for (std::size_t k = 0; k < c->samples.size(); ++k)
    if (r.TimeAt(k) >= from) {
      mean += c->samples[k];
      n += 1;
    }
  mean /= n;
  for (std::size_t k = 0; k < c->samples.size(); ++k)
    if (r.TimeAt(k) >= from)
      sum += (c->samples[k] - mean) * std::polar(1.0, -2 * std::numbers::pi * hertz * r.TimeAt(k));
  return 2.0 * std::complex<double>(0, 1) * sum / n;  // against a sine
}

// A small sine on the force of one axis, in the nonlinear switching engine: the readings of all
// axes are those of the linear loop. 40 to 400 Hz covers crossover; whole periods of each in the
// time that is fitted.
TEST(ControlPlant, ClosedLoopOfTheSwitchingEngine) {
  const RigParameters rig = RigWith("kind = \"pid\"\n" + kPidGains);
  const SampledPlant plant = MakeControlPlant(rig, {0, 1, 2, 3, 4}, 0);
  const auto controller = MakeController(NominalRig(rig), rig.controller);
  for (const double hertz : {40.0, 120.0, 400.0}) {
    const Scenario s = ReadScenarioText(
        "name = \"sine\"\nduration = 0.2\nnoise = false\nfault_tolerance = "
        "false\n[[excitation]]\ntarget = \"A.x\"\n"
        "kind = \"sine\"\namplitude = 1.0\nfrequency = " +
            std::to_string(hertz) + "\n",
        "s.toml", rig);
    const RunResult run = Simulate(rig, s, {});
    const std::complex<double> z = std::polar(1.0, 2 * std::numbers::pi * hertz * plant.Ts);
    const Eigen::MatrixXcd P = plant.FromForce().Response(z), K = controller->Linear(0).Response(z);
    const Eigen::VectorXcd y = (Eigen::MatrixXcd::Identity(5, 5) - P * K).inverse() * P.col(0);
    for (const auto& [name, row] : {std::pair{"A.x", 0}, std::pair{"B.x", 2}}) {
      const std::complex<double> measured = SineFit(run.record, name, hertz, 0.1);
      EXPECT_LT(std::abs(measured - y[row]), 0.02 * std::abs(y[0]))
          << hertz << ' ' << name << ' ' << std::abs(measured) << ' ' << std::abs(y[row]);
    }
  }
}

// With other true values than the controller's: its force constant turns the command into current,
// the plant's makes the force.
TEST(ControlPlant, ControllersKnowledgeAndTruth) {
  const RigParameters nominal = RigWith("kind = \"pid\"\n" + kPidGains);
  RigParameters narrow = nominal;
  for (BearingParameters& b : narrow.bearings) b.radial.gap *= 0.98;
  const auto gain = [&](const RigParameters* knows) {
    return std::abs(MakeControlPlant(narrow, kRadial, 0, knows)
                        .FromForce()
                        .Response(std::polar(1.0, 0.5))(0, 0));
  };
  // k ~ 1/g0²; the weight is carried by other currents, which the stiffness feels a little
  EXPECT_NEAR(gain(&nominal) / gain(nullptr), 1 / (0.98 * 0.98), 1e-4);
}

}  // namespace
}  // namespace ambrig
