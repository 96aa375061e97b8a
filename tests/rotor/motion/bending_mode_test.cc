// Modes along the shaft and on a rotor: cubic pieces, straight ends, energy, gyroscopic forces.
#include "rotor/motion/bending_mode.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rotor/shaft/reduction.h"
#include "tests/rotor/shaft/uniform_shaft.h"

namespace ambrig {
namespace {

/// A cubic g(z) = 1 + 2 z - 30 z² + 100 z³ in pieces of 0.05 m over -0.1 to 0.1 m.
double Cubic(double z) { return 1 + 2 * z - 30 * z * z + 100 * z * z * z; }
double Slope(double z) { return 2 - 60 * z + 300 * z * z; }

BendingMode ModeOfCubic() {
  BendingMode m;
  m.omega = 500;
  m.damping = 0.01;
  const double h = 0.05;
  for (int k = 0; k <= 4; ++k) {
    const double z = -0.1 + h * k;
    ShapePoint p{z, Cubic(z), 0, 0};
    // The remainder of a cubic over the line: u (1 - u) (bend + twist u) with these two.
    p.twist = -100 * h * h * h;
    p.bend = -(-30 + 300 * z) * h * h - 100 * h * h * h;
    m.shape.push_back(p);
  }
  return m;
}

TEST(BendingMode, PiecesReproduceACubic) {
  const BendingMode m = ModeOfCubic();
  for (double z = -0.1; z <= 0.1; z += 0.007) EXPECT_NEAR(m.Gain(z), Cubic(z), 1e-12) << z;
}

// Beyond the ends the shaft goes straight on, with the slope that it has there.
TEST(BendingMode, GoesStraightOnBeyondItsEnds) {
  const BendingMode m = ModeOfCubic();
  EXPECT_NEAR(m.Gain(-0.13), Cubic(-0.1) - 0.03 * Slope(-0.1), 1e-12);
  EXPECT_NEAR(m.Gain(0.16), Cubic(0.1) + 0.06 * Slope(0.1), 1e-12);
}

TEST(BendingMode, OfOnePointOrNoneIsConstant) {
  BendingMode m;
  EXPECT_EQ(m.Gain(0.3), 0);
  m.shape = {{0.1, 2.5, 0, 0}};
  EXPECT_EQ(m.Gain(-4), 2.5);
}

// A disk's polar inertia moves no mode at rest. It turns with the rotor's tilt as it is and with a
// mode by the slope there: it adds Ip s sᵀ to J, s = (1, slopes).
TEST(BendingMode, ADiskAddsTheGyroscopicsOfItsSlopes) {
  const double Ip = 0.0075, z = 0.42;
  BeamDefinition d = UniformShaft(0.6, 0.02, 6);
  d.disks = {{z, 2.0, 0.004, 0, "disk"}};
  const std::vector<BendingMode> without = BendingModes(Reduce(BuildBeam(d), 3, {0.0}));
  d.disks[0].inertia_polar = Ip;
  const ReducedRotor r = Reduce(BuildBeam(d), 3, {0.0});
  const std::vector<BendingMode> with = BendingModes(r);
  const Eigen::VectorXd slope = StationAt(r, z).slope;
  ASSERT_EQ(with.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const double own = slope(static_cast<Eigen::Index>(k));
    EXPECT_GT(std::abs(own - 1), 0.5) << k;
    EXPECT_NEAR(with[k].gyroscopic_tilt - without[k].gyroscopic_tilt, Ip * own, 1e-9) << k;
    EXPECT_NEAR(with[k].gyroscopic - without[k].gyroscopic, Ip * own * own, 1e-9) << k;
    ASSERT_EQ(with[k].gyroscopic_other.size(), k);
    for (std::size_t l = 0; l < k; ++l)
      EXPECT_NEAR(with[k].gyroscopic_other[l] - without[k].gyroscopic_other[l],
                  Ip * own * slope(static_cast<Eigen::Index>(l)), 1e-9);
  }
}

BendingMode Plain(double omega, double damping, double gyroscopic, double tilt = 0) {
  BendingMode m;
  m.omega = omega;
  m.damping = damping;
  m.gyroscopic = gyroscopic;
  m.gyroscopic_tilt = tilt;
  m.shape = {{-0.1, 1, 0, 0}, {0.1, 1, 0, 0}};
  return m;
}

constexpr int kDof = 5;

TEST(ModalShaft, ForcesAreStiffnessDampingAndGyroscopics) {
  ModalShaft shaft(0.04, 0.004);
  EXPECT_TRUE(shaft.empty());
  shaft.Add(Plain(400, 0.02, 0.3), kDof);
  MotionState s;
  s.Omega = 150;
  s.q[kDof] = 2e-4;
  s.q[kDof + 1] = -1e-4;
  s.v[kDof] = 0.03;
  s.v[kDof + 1] = 0.05;
  DofVector Q{};
  shaft.AddForces(s, Q);
  EXPECT_NEAR(Q[kDof], -400 * 400 * 2e-4 - 2 * 0.02 * 400 * 0.03 - 150 * 0.3 * 0.05, 1e-10);
  EXPECT_NEAR(Q[kDof + 1], 400 * 400 * 1e-4 - 2 * 0.02 * 400 * 0.05 + 150 * 0.3 * 0.03, 1e-10);
  EXPECT_NEAR(shaft.Energy(s), 0.5 * (400 * 400 * (4e-8 + 1e-8) + 0.03 * 0.03 + 0.05 * 0.05),
              1e-12);
}

// Undamped, all forces together do the work that the elastic energy loses: the gyroscopic ones
// none, also where modes couple with each other and with the tilt.
TEST(ModalShaft, GyroscopicForcesDoNoWork) {
  ModalShaft shaft(0.04, 0.004);
  shaft.Add(Plain(400, 0, 0.3, 0.05), kDof);
  BendingMode second = Plain(900, 0, 0.1, -0.02);
  second.gyroscopic_other = {0.07};
  shaft.Add(second, kDof + 2);
  MotionState s;
  s.Omega = 300;
  for (std::size_t d = 0; d < s.v.size(); ++d) s.v[d] = 0.01 * (static_cast<double>(d) - 3.3);
  DofVector Q{};
  shaft.AddForces(s, Q);  // q = 0: no elastic force
  double power = 0, size = 0;
  for (std::size_t d = 0; d < s.v.size(); ++d) {
    power += Q[d] * s.v[d];
    size += std::abs(Q[d] * s.v[d]);
  }
  EXPECT_GT(size, 1e-3);
  EXPECT_LT(std::abs(power), 1e-12 * size + 1e-15);
}

// The bound of the rates rises with the speed, either way round.
TEST(ModalShaft, TheRateIsABoundOfTheWhirls) {
  ModalShaft shaft(0.04, 0.004);
  shaft.Add(Plain(400, 0, 0.3), kDof);
  EXPECT_DOUBLE_EQ(shaft.Rate(500), shaft.Rate(-500));
  // w² - J Omega w - w0² = 0: the forward whirl.
  const double b = 0.3 * 500, forward = 0.5 * (b + std::sqrt(b * b + 4 * 400 * 400));
  EXPECT_GE(shaft.Rate(500), forward);
  EXPECT_GE(shaft.Rate(0), 400);
}

}  // namespace
}  // namespace ambrig
