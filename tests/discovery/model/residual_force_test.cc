// The force that a record lacks, from motions, currents and loads that are written down.
#include "discovery/model/residual_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/rig_figures.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

constexpr double kResidualForceRate = 12500, kCutoff = 300;
constexpr std::size_t kResidualForceRows = 2500;

Scenario Levitated(const RigParameters& rig, const std::string& more = "") {
  return ReadScenarioText(
      "name = \"r\"\nrig = \"rig.toml\"\nduration = 0.2\nrecord_rate = 12500.0\n[start]\nstate = "
      "\"levitated\"\n[speed]\nprofile = [[0.0, 200.0]]\n" +
          more,
      "r.toml", rig);
}

/// Readings of the four sensors as functions of time, every coil of A and B with these currents.
Record RecordOf(const std::function<double(int, double)>& reading,
                const std::function<double(int, int)>& current) {
  Record d;
  d.rate = kResidualForceRate;
  const char* const axes[] = {"A.x", "A.y", "B.x", "B.y"};
  for (int a = 0; a < 4; ++a) {
    Channel c{axes[a], "m", {}};
    for (std::size_t k = 0; k < kResidualForceRows; ++k)
      c.samples.push_back(reading(a, static_cast<double>(k) / kResidualForceRate));
    d.channels.push_back(c);
  }
  for (int b = 0; b < 2; ++b)
    for (int j = 1; j <= 8; ++j)
      d.channels.push_back({std::string(b == 0 ? "A" : "B") + ".i" + std::to_string(j), "A",
                            std::vector<double>(kResidualForceRows, current(b, j - 1))});
  return d;
}

double NoCurrent(int, int) { return 0; }
double Still(int, double) { return 0; }

// Nothing moves and no magnet pulls: what is missing holds the weight, shared by the levers.
TEST(ResidualForce, WithoutMagnetsTheWeightIsMissing) {
  const RigParameters rig = ReferenceRig();
  const auto f = EstimateResidualForce(rig, Levitated(rig), RecordOf(Still, NoCurrent), kCutoff);
  ASSERT_TRUE(f);
  ASSERT_EQ(f->planes.size(), 2u);
  const auto shares = WeightShares(rig);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(f->planes[b].bearing, b == 0 ? "A" : "B");
    EXPECT_NEAR(f->planes[b].fx[kResidualForceRows / 2], shares[b][0], 1e-9);
    EXPECT_NEAR(f->planes[b].fy[kResidualForceRows / 2], shares[b][1], 1e-9);
  }
  EXPECT_EQ(f->t.size(), kResidualForceRows);
  EXPECT_DOUBLE_EQ(f->omega[7], 200);
  EXPECT_NEAR(f->theta[1000], 200 * 0.08, 1e-9);
}

// i_j = c0 + v cos γ_j makes k c0 v along x exactly, at the centre.
TEST(ResidualForce, MagneticForceIsThatOfTheCurrents) {
  const RigParameters rig = ReferenceRig();
  const double c0 = 2, v = 0.4;
  const auto f = EstimateResidualForce(
      rig, Levitated(rig),
      RecordOf(Still,
               [&](int b, int j) {
                 const auto d = CoilDirections(rig.bearings[static_cast<std::size_t>(b)]);
                 const auto& [x, y] = d[static_cast<std::size_t>(j)];
                 return c0 + v * (b == 0 ? x : y);
               }),
      kCutoff);
  ASSERT_TRUE(f);
  const auto shares = WeightShares(rig);
  const double a = ForceConstant(rig.bearings[0]) * c0 * v,
               b = ForceConstant(rig.bearings[1]) * c0 * v;
  EXPECT_NEAR(f->planes[0].magnetic_x[900], a, 1e-6 * a);
  EXPECT_NEAR(f->planes[1].magnetic_y[900], b, 1e-6 * b);
  EXPECT_NEAR(f->planes[0].fx[900], shares[0][0] - a, 1e-6 * a);
  EXPECT_NEAR(f->planes[0].fy[900], shares[0][1], 1e-6 * a);
  EXPECT_NEAR(f->planes[1].fy[900], shares[1][1] - b, 1e-6 * b);
}

// A translation x = a sin ωt needs m a'' altogether and no moment; the filter takes 2^-(f/fc)²/2.
TEST(ResidualForce, ATranslationNeedsTheMassTimesItsAcceleration) {
  const RigParameters rig = ReferenceRig();
  const double amplitude = 2e-5, f0 = 40, w = 2 * kPi * f0;
  const auto f = EstimateResidualForce(
      rig, Levitated(rig),
      RecordOf([&](int axis, double t) { return axis % 2 == 0 ? amplitude * std::sin(w * t) : 0; },
               NoCurrent),
      kCutoff);
  ASSERT_TRUE(f);
  const double passed = std::pow(2, -0.5 * std::pow(f0 / kCutoff, 2));
  const double zA = rig.bearings[0].z, zB = rig.bearings[1].z;
  for (const std::size_t k : {700u, 1100u, 1555u}) {
    const double need = -rig.rotor.mass * w * w * amplitude * passed *
                        std::sin(w * static_cast<double>(k) / kResidualForceRate),
                 scale = rig.rotor.mass * w * w * amplitude;
    EXPECT_NEAR(f->planes[0].fx[k] + f->planes[1].fx[k], need, 1e-3 * scale);
    EXPECT_NEAR(zA * f->planes[0].fx[k] + zB * f->planes[1].fx[k], 0, 1e-3 * scale * zB);
    EXPECT_NEAR(f->planes[0].vx[k],
                w * amplitude * passed * std::cos(w * static_cast<double>(k) / kResidualForceRate),
                1e-3 * w * amplitude);
  }
}

// A conical motion needs the transverse inertia times its angular acceleration, and across it the
// gyroscopic moment: the spin's Ip Ω points along the shaft, which tilts by β towards x, so that
// its part along x changes with Ip Ω β'.
TEST(ResidualForce, AConicalMotionNeedsInertiaAndGyroscopicMoment) {
  const RigParameters rig = ReferenceRig();
  const double tilt = 2e-4, f0 = 30, w = 2 * kPi * f0;
  const auto f = EstimateResidualForce(rig, Levitated(rig),
                                       RecordOf(
                                           [&](int axis, double t) {
                                             const double z = rig.bearings[axis / 2].sensor.z;
                                             return axis % 2 == 0 ? z * tilt * std::sin(w * t) : 0;
                                           },
                                           NoCurrent),
                                       kCutoff);
  ASSERT_TRUE(f);
  const double passed = std::pow(2, -0.5 * std::pow(f0 / kCutoff, 2));
  const double zA = rig.bearings[0].z, zB = rig.bearings[1].z;
  const auto shares = WeightShares(rig);
  for (const std::size_t k : {800u, 1303u}) {
    const double phase = w * static_cast<double>(k) / kResidualForceRate;
    const double My = -rig.rotor.inertia_transverse * w * w * tilt * passed * std::sin(phase),
                 Mx = rig.rotor.inertia_polar * 200 * w * tilt * passed * std::cos(phase);
    const auto &A = f->planes[0], &B = f->planes[1];
    const double scale = rig.rotor.inertia_transverse * w * w * tilt;
    EXPECT_NEAR(zA * A.fx[k] + zB * B.fx[k], My, 2e-3 * scale);
    EXPECT_NEAR(A.fx[k] + B.fx[k], 0, 2e-3 * scale / zB);
    // Forces along y about the x axis: -z fy.
    EXPECT_NEAR(-zA * (A.fy[k] - shares[0][1]) - zB * (B.fy[k] - shares[1][1]), Mx, 2e-3 * scale);
  }
}

TEST(ResidualForce, ALoadCarriesItsShareFromItsStartToItsStop) {
  const RigParameters rig = ReferenceRig();
  const Scenario s = Levitated(rig,
                               "[[load]]\nplane = \"B\"\nforce = [7.0, -2.0]\nstart = 0.05\nstop = "
                               "0.12\n");
  const auto f = EstimateResidualForce(rig, s, RecordOf(Still, NoCurrent), kCutoff);
  const auto without =
      EstimateResidualForce(rig, Levitated(rig), RecordOf(Still, NoCurrent), kCutoff);
  ASSERT_TRUE(f && without);
  for (std::size_t k = 0; k < kResidualForceRows; ++k) {
    const double t = f->t[k];
    const bool on = t >= 0.05 && t < 0.12;
    EXPECT_NEAR(f->planes[1].fx[k] - without->planes[1].fx[k], on ? -7 : 0, 1e-9) << t;
    EXPECT_NEAR(f->planes[1].fy[k] - without->planes[1].fy[k], on ? 2 : 0, 1e-9) << t;
    EXPECT_NEAR(f->planes[0].fx[k], without->planes[0].fx[k], 1e-9) << t;
  }
}

TEST(ResidualForce, NeedsAFreeRigidRotorAndAllChannels) {
  RigParameters rig = ReferenceRig();
  const Record whole = RecordOf(Still, NoCurrent);
  EXPECT_TRUE(EstimateResidualForce(rig, Levitated(rig), whole));
  for (const std::size_t lost : {1u, 9u}) {  // a reading, a current
    Record less = whole;
    less.channels.erase(less.channels.begin() + static_cast<std::ptrdiff_t>(lost));
    EXPECT_FALSE(EstimateResidualForce(rig, Levitated(rig), less)) << lost;
  }
  Scenario held = Levitated(rig);
  held.start = StartState::kClamped;
  EXPECT_FALSE(EstimateResidualForce(rig, held, whole));
  const Scenario free = Levitated(rig);
  rig.modes.emplace_back();
  EXPECT_FALSE(EstimateResidualForce(rig, free, whole));
}

}  // namespace
}  // namespace ambrig
