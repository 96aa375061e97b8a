// The circuit of a radial bearing against closed forms, conservation and symmetry.
#include "actuators/magnetics/radial_stator.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/math/constants.h"

namespace ambrig {
namespace {

RadialStatorParameters Magnet() {
  RadialStatorParameters p;
  p.turns = 110;
  p.pole_area = 1.4e-4;
  p.gap = 4e-4;
  p.leakage_inductance = 3e-4;
  p.resistance = 0.6;
  return p;
}

CoilVector Uneven() {
  CoilVector i;
  i << 2.1, 1.3, 0.4, 3.0, 2.2, 0.9, 1.7, 2.6;
  return i;
}

const Eigen::Vector2d kAside{8e-5, -5e-5};  // [m]

// A pair of poles of opposite sense in a centred rotor: B = mu0 N i/g, each pulls B² A/(2 mu0).
TEST(RadialStatorClosedForm, APairOfPolesPullsAsMaxwellSays) {
  const RadialStatorParameters p = Magnet();
  const RadialStator stator(p);
  const double current = 2.5, B = kMu0 * p.turns * current / p.gap;
  CoilVector i = CoilVector::Zero();
  i[0] = i[1] = current;
  const CoilVector phi = stator.Flux(Eigen::Vector2d::Zero(), i);
  EXPECT_NEAR(phi[0], stator.sense()[0] * B * p.pole_area, 1e-12 * B);
  EXPECT_NEAR(phi[1], -phi[0], 1e-15);
  for (int j = 2; j < kPoles; ++j) EXPECT_NEAR(phi[j], 0, 1e-15);
  const double pull = B * B * p.pole_area / (2 * kMu0);
  const Eigen::Vector2d f = stator.Force(Eigen::Vector2d::Zero(), i);
  EXPECT_NEAR(f.x(), pull * (stator.cosine()[0] + stator.cosine()[1]), 1e-9 * pull);
  EXPECT_NEAR(f.y(), pull * (stator.sine()[0] + stator.sine()[1]), 1e-9 * pull);
}

TEST(RadialStatorGap, IsTheDistanceAlongThePole) {
  const RadialStatorParameters p = Magnet();
  const RadialStator stator(p);
  const CoilVector g = stator.Gap(kAside);
  for (int j = 0; j < kPoles; ++j) {
    const double angle = (p.first_pole_angle_deg + 45.0 * j) * kPi / 180;
    EXPECT_NEAR(g[j], p.gap - kAside.x() * std::cos(angle) - kAside.y() * std::sin(angle), 1e-15);
  }
  // Opposite gaps add up to two nominal ones.
  for (int j = 0; j < kPoles / 2; ++j) EXPECT_NEAR(g[j] + g[j + 4], 2 * p.gap, 1e-15);
}

TEST(RadialStatorConservation, NoFluxIsLostInTheRotor) {
  const RadialStator stator(Magnet());
  const CoilVector phi = stator.Flux(kAside, Uneven());
  EXPECT_NEAR(phi.sum(), 0, 1e-14 * phi.cwiseAbs().sum() + 1e-18);
}

// Coils that all push the same way move no flux: there is no way back.
TEST(RadialStatorConservation, EqualMagnetomotiveForcesMakeNoFlux) {
  const RadialStator stator(Magnet());
  const CoilVector i = 1.5 * stator.sense();
  EXPECT_NEAR(stator.Flux(kAside, i).cwiseAbs().maxCoeff(), 0, 1e-15);
  EXPECT_NEAR(stator.Force(kAside, i).norm(), 0, 1e-9);
}

TEST(RadialStatorInductance, IsReciprocalPositiveAndLinksTheFluxes) {
  const RadialStatorParameters p = Magnet();
  const RadialStator stator(p);
  const CoilMatrix L = stator.Inductance(kAside);
  EXPECT_LT((L - L.transpose()).norm(), 1e-15 * L.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<CoilMatrix>(L).eigenvalues().minCoeff(),
            p.leakage_inductance * (1 - 1e-9));
  const CoilVector i = Uneven(), linkage = L * i;
  const CoilVector phi = stator.Flux(kAside, i);
  for (int j = 0; j < kPoles; ++j)
    EXPECT_NEAR(linkage[j], p.turns * stator.sense()[j] * phi[j] + p.leakage_inductance * i[j],
                1e-12);
  EXPECT_LT((stator.Currents(kAside, linkage) - i).norm(), 1e-10 * i.norm());
}

// The force is the gradient of the co-energy ½ i' L i at constant currents.
TEST(RadialStatorForce, IsTheGradientOfTheCoEnergy) {
  const RadialStator stator(Magnet());
  const CoilVector i = Uneven();
  const auto energy = [&](const Eigen::Vector2d& r) {
    return 0.5 * i.dot(stator.Inductance(r) * i);
  };
  const double h = 1e-7;
  const Eigen::Vector2d f = stator.Force(kAside, i);
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::Vector2d step = Eigen::Vector2d::Zero();
    step[axis] = h;
    // Error of a central difference: h²/6 f'' ~ f (h/g)²; of rounding: eps W/h.
    EXPECT_NEAR((energy(kAside + step) - energy(kAside - step)) / (2 * h), f[axis],
                1e-5 * f.norm() + 1e-6);
  }
}

// Forces are quadratic in the currents and do not know their sign.
TEST(RadialStatorForce, IsQuadraticAndEven) {
  const RadialStator stator(Magnet());
  const Eigen::Vector2d f = stator.Force(kAside, Uneven());
  EXPECT_LT((stator.Force(kAside, 2 * Uneven()) - 4 * f).norm(), 1e-12 * f.norm());
  EXPECT_LT((stator.Force(kAside, -Uneven()) - f).norm(), 1e-12 * f.norm());
}

// Turned by one pole pair (90 degrees), rotor and currents with it, the force turns too.
TEST(RadialStatorSymmetry, TurnsWithItsPoles) {
  const RadialStator stator(Magnet());
  CoilVector turned;
  for (int j = 0; j < kPoles; ++j) turned[(j + 2) % kPoles] = Uneven()[j];
  const Eigen::Vector2d f = stator.Force(kAside, Uneven());
  const Eigen::Vector2d g = stator.Force({-kAside.y(), kAside.x()}, turned);
  EXPECT_NEAR(g.x(), -f.y(), 1e-9 * f.norm());
  EXPECT_NEAR(g.y(), f.x(), 1e-9 * f.norm());
}

// A centred rotor in equal currents feels nothing, and is pulled the way it is displaced.
TEST(RadialStatorSymmetry, IsInUnstableEquilibriumAtTheCentre) {
  const RadialStator stator(Magnet());
  const CoilVector bias = CoilVector::Constant(2.0);
  const double scale = stator.ForceConstant() * 4;
  EXPECT_NEAR(stator.Force(Eigen::Vector2d::Zero(), bias).norm(), 0, 1e-12 * scale);
  for (const double angle : {0.0, 0.7, 2.0, 4.4}) {
    const Eigen::Vector2d r = 1e-5 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d f = stator.Force(r, bias);
    EXPECT_GT(f.dot(r), 0.999 * f.norm() * r.norm());
  }
}

}  // namespace
}  // namespace ambrig
