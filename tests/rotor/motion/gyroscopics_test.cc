/// Rigid rotor: gyroscopic motion in closed form, the order of the engine's steps, and the
/// eigenvalues of a published set (docs/theory/published_values.md 3).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <complex>

#include "rotor/motion/rotor_model.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;
constexpr RotorParameters kGyroscopicsReference = {4.2, 0.036, 0.0042, 0.03};

RotorModel Spinning(const RotorParameters& p, double Omega) {
  RotorModel m(p, {0, 0, 0});
  m.SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, Omega}}));
  return m;
}

// It alpha'' + Ip Omega beta' = 0, It beta'' - Ip Omega alpha' = 0: the tilt rate turns with Omega
// Ip/It, forward. ALPHA = alpha + i beta: ALPHA' = ALPHA0' e^(i w t).
double PrecessionError(double dt) {
  const double Omega = 1257, w = Omega * 0.0042 / 0.036, end = 0.02;
  const RotorModel m = Spinning(kGyroscopicsReference, Omega);
  MotionState s;
  s.v[3] = 0.3;
  const int steps = static_cast<int>(std::lround(end / dt));
  for (int n = 0; n < steps; ++n) m.Step(s, {}, 0, 0, dt);
  const Complex rate = 0.3 * std::exp(Complex(0, w * end));
  const Complex tilt = 0.3 * (std::exp(Complex(0, w * end)) - 1.0) / Complex(0, w);
  return std::abs(Complex(s.v[3], s.v[4]) - rate) + w * std::abs(Complex(s.q[3], s.q[4]) - tilt);
}

TEST(Gyroscopics, NutationOfAFreeRotorInClosedForm) { EXPECT_LT(PrecessionError(40e-6), 1e-9); }

// Runge-Kutta of order four.
TEST(Gyroscopics, StepsConvergeWithOrderFour) {
  const double e[3] = {PrecessionError(1e-3), PrecessionError(5e-4), PrecessionError(2.5e-4)};
  EXPECT_NEAR(std::log2(e[0] / e[1]), 4, 0.1);
  EXPECT_NEAR(std::log2(e[1] / e[2]), 4, 0.1);
}

class NoForce final : public ForceTerm {
 public:
  void Add(const MotionState&, RotorForces&) const override {}
};

// A rotor that only given forces move takes a shorter way through the step: the same to rounding.
TEST(Gyroscopics, TheStepOfAFreeFlightIsTheGeneralOne) {
  for (const double free_from : {kInfinity, 0.01}) {
    RotorModel flying(kGyroscopicsReference, {0, -9.81, 0.5}),
        general(kGyroscopicsReference, {0, -9.81, 0.5});
    for (RotorModel* m : {&flying, &general}) {
      m->axial_free = true;
      m->SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, 100.0}, {0.02, 900.0}}),
                  free_from);
      m->AddLoad(0.07, 3, -2, 1, 0.00411, 0.0123);
    }
    general.terms.push_back(std::make_unique<NoForce>());
    MotionState a, b;
    a.v[3] = b.v[3] = 0.3;
    for (int n = 0; n < 500; ++n) {
      const double swing = std::sin(0.05 * n);
      const DofVector Q = {20 * swing, 30 - swing, 5, 0.4 * swing, -0.7};
      flying.Step(a, Q, 0, 0, 40e-6);
      general.Step(b, Q, 0, 0, 40e-6);
    }
    for (std::size_t d = 0; d < 5; ++d) {
      EXPECT_GT(std::abs(b.q[d]), 1e-6) << d;  // it moved
      EXPECT_NEAR(a.q[d], b.q[d], 1e-13 * (1 + std::abs(b.q[d]))) << d;
      EXPECT_NEAR(a.v[d], b.v[d], 1e-12 * (1 + std::abs(b.v[d]))) << d;
    }
    EXPECT_NEAR(a.theta, b.theta, 1e-12 * b.theta);
    EXPECT_NEAR(a.Omega, b.Omega, 1e-12 * b.Omega);
    EXPECT_EQ(a.t, b.t);
  }
}

/// Linear rig of published_values.md 3: x' = A x of (q, v), from the model's accelerations column
/// by column.
struct PublishedRig {
  static constexpr RotorParameters kRotor = {2.3, 6e-2, 8e-4, 0.01};
  static constexpr double kArm[2] = {-0.241, 0.139}, kSensor[2] = {-0.241, 0.119};
  static constexpr double kKs = 144e3, kKi = 38;

  Eigen::Matrix<double, 8, 8> System(double Omega, double kp, double kd) const {
    const RotorModel m = Spinning(kRotor, Omega);
    Eigen::Matrix<double, 8, 8> A = Eigen::Matrix<double, 8, 8>::Zero();
    const std::size_t at[4] = {0, 1, 3, 4};  // x, y, alpha, beta
    for (int column = 0; column < 8; ++column) {
      MotionState s;
      s.Omega = Omega;
      (column < 4 ? s.q : s.v)[at[column % 4]] = 1;
      DofVector Q{}, a{};
      for (int k = 0; k < 2; ++k) {
        const PlaneMap magnet = m.MakePlane(kArm[k]), sensor = m.MakePlane(kSensor[k]);
        const auto force = [&](double gap, double reading, double rate) {
          return kKs * gap - kKi * (kp * reading + kd * rate);
        };
        magnet.AddForce(force(magnet.X(s.q), sensor.X(s.q), sensor.X(s.v)),
                        force(magnet.Y(s.q), sensor.Y(s.q), sensor.Y(s.v)), Q);
      }
      double torque = 0;
      m.Accelerations(s, Q, 0, 0, a, &torque);
      for (int d = 0; d < 4; ++d) {
        A(d, column) = s.v[at[d]];
        A(4 + d, column) = a[at[d]];
      }
    }
    return A;
  }
  /// Whether some eigenvalue is within `tolerance` of each expected one.
  static void ExpectEigenvalues(const Eigen::Matrix<double, 8, 8>& A,
                                const std::vector<Complex>& expected, double tolerance) {
    const auto found = Eigen::EigenSolver<Eigen::Matrix<double, 8, 8>>(A).eigenvalues().eval();
    for (const Complex& e : expected) {
      double nearest = 1e9;
      for (int k = 0; k < 8; ++k) nearest = std::min(nearest, std::abs(found[k] - e));
      EXPECT_LT(nearest, tolerance) << e << "\n" << found.transpose();
    }
  }
};

// Open loop at standstill: 325.1 and 453.1 rad/s, both signs.
TEST(PublishedRig, UnstablePolesWithoutControl) {
  PublishedRig::ExpectEigenvalues(PublishedRig().System(0, 0, 0), {325.1, -325.1, 453.1, -453.1},
                                  0.06);
}

// With PD through the non-collocated sensors. kd is printed with five digits: half of the last one
// moves a real part of 401 by 0.013, and the imaginary part beside it by 0.027.
TEST(PublishedRig, ClosedLoopAtStandstillAndAtSpeed) {
  const PublishedRig rig;
  PublishedRig::ExpectEigenvalues(
      rig.System(0, 7578.9, 14.993),
      {{-200.41, 237.74}, {-200.41, -237.74}, {-401.57, 198.83}, {-401.57, -198.83}}, 0.045);
  const double Omega = 20000 * 2 * std::acos(-1.0) / 60;
  PublishedRig::ExpectEigenvalues(
      rig.System(Omega, 7578.9, 14.993),
      {{-198.08, -233.57}, {-202.73, 241.37}, {-379.11, -191.06}, {-424.04, 211.18}}, 0.045);
}

// A force at z: x'' = f/m at the centre, Mx = -z fy, My = z fx; the point of a plane moves with all
// three.
TEST(RigidRotor, MobilityAtAPlane) {
  const RotorModel m = Spinning(kGyroscopicsReference, 0);
  const PlaneMap a = m.MakePlane(-0.12), b = m.MakePlane(0.145);
  DofVector Q{}, acceleration{};
  a.AddForce(3, -2, Q);
  double torque = 0;
  m.Accelerations({}, Q, 0, 0, acceleration, &torque);
  const double cross = 1 / 4.2 + (-0.12) * 0.145 / 0.036;
  EXPECT_NEAR(b.X(acceleration), 3 * cross, 1e-12);
  EXPECT_NEAR(b.Y(acceleration), -2 * cross, 1e-12);
}

// A load enters with its mean over each step: its impulse is exact even when it starts inside one.
TEST(RigidRotor, LoadsHaveTheirExactImpulse) {
  RotorModel m = Spinning(kGyroscopicsReference, 0);
  m.AddLoad(0, 5, -7, 0, 0.000133, 0.001007);
  MotionState s;
  for (int n = 0; n < 40; ++n) m.Step(s, {}, 0, 0, 40e-6);
  EXPECT_NEAR(s.v[0], 5 * 0.000874 / 4.2, 1e-15);
  EXPECT_NEAR(s.v[1], -7 * 0.000874 / 4.2, 1e-15);
}

// Released at 1000 rad/s with an exact braking moment through a contact-free run: nothing brakes.
TEST(RigidRotor, AFreeSpinKeepsItsSpeedAndAngle) {
  RotorModel m(kGyroscopicsReference, {0, 0, 0});
  m.SetSpeed(SpeedProfile(std::vector<std::vector<double>>{{0.0, 1000.0}}), 0.01);
  MotionState s;
  m.SetSpin(s);
  for (int n = 0; n < 1000; ++n) m.Step(s, {}, 0, 0, 40e-6);
  EXPECT_NEAR(s.Omega, 1000, 1e-12);
  EXPECT_NEAR(s.theta, 1000 * 0.04, 1e-9);
}

}  // namespace
}  // namespace ambrig
