// Networks of stators of all kinds against closed forms: k_i and k_s of differential drive, fluxes
// of permanent magnets, forces beyond the linear ones, and virtual work.
#include "actuators/magnetics/pole_network.h"

#include <gtest/gtest.h>

#include <cmath>

#include "actuators/magnetics/radial_stator.h"
#include "actuators/magnetics/stator_parameters.h"
#include "core/math/constants.h"
#include "tests/actuators/magnetics/template_stator.h"

namespace ambrig {
namespace {

constexpr double kArea = 2e-4, kGap = 4e-4, kTurns = 100, kBias = 2;  // [m2], [m], -, [A]
const double kB0 = kMu0 * kTurns * kBias / kGap;                      // [T]
constexpr double kClose = 1e-9;                                       // relative

StatorParameters Of(const std::string& pattern) {
  return testing::TemplateStator(pattern, {kTurns, kArea, kGap, 1e-3});
}

/// Four coils +x, +y, -x, -y: i0 + i, i0, i0 - i, i0.
double GainOfDifferentialDrive(const StatorParameters& p) {
  const auto network = NetworkOf(p);
  const auto J = network->ForceOfCurrent(Eigen::Vector3d::Zero(), Eigen::Vector4d::Constant(kBias));
  return J(0, 0) - J(0, 2);
}

Eigen::Matrix3d StiffnessAtBias(const StatorParameters& p) {
  const auto network = NetworkOf(p);
  return network->NegativeStiffness(Eigen::Vector3d::Zero(),
                                    Eigen::VectorXd::Constant(network->coils(), kBias));
}

void ExpectNear(double value, double closed) {
  EXPECT_NEAR(value, closed, kClose * std::abs(closed));
}

TEST(PoleNetwork, QuadrantsInSeries) {
  for (const auto& [poles, winding] :
       {std::pair{8, "NS"}, {8, "NNSS"}, {8, "NSNSNSNS"}, {16, "NS"}, {24, "NS"}}) {
    StatorParameters p = Of("series-pairs");
    p.pole_count = poles;
    p.winding = winding;
    double cosines = 0;
    for (int k = 0; k < poles; ++k) {
      const double angle = (k + 0.5) * 360 / poles;
      if (angle < 45 || angle > 315) cosines += std::cos(angle * kPi / 180);
    }
    ExpectNear(GainOfDifferentialDrive(p), 2 * kArea * kB0 * kB0 / (kMu0 * kBias) * cosines);
    ExpectNear(StiffnessAtBias(p)(0, 0), poles * kArea * kB0 * kB0 / (2 * kMu0 * kGap));
    EXPECT_NEAR(StiffnessAtBias(p)(0, 1), 0, 1e-6 * StiffnessAtBias(p)(0, 0));
  }
}

TEST(PoleNetwork, PublishedNumbersOfSeriesPairs) {
  StatorParameters p = Of("series-pairs");
  EXPECT_NEAR(GainOfDifferentialDrive(p), 116.0981, 5e-5);
  EXPECT_NEAR(StiffnessAtBias(p)(0, 0), 628318.5, 0.05);
  p.pole_count = 16;
  EXPECT_NEAR(GainOfDifferentialDrive(p), 227.7347, 5e-5);
  p.pole_count = 24;
  EXPECT_NEAR(GainOfDifferentialDrive(p), 340.3825, 5e-5);
}

TEST(PoleNetwork, OnlyOnePairBiased) {
  const auto network = NetworkOf(Of("series-pairs"));
  const Eigen::Vector4d current(kBias, 0, kBias, 0);
  const double c = std::cos(22.5 * kPi / 180);
  const auto J = network->ForceOfCurrent(Eigen::Vector3d::Zero(), current);
  EXPECT_NEAR(J(0, 0) - J(0, 2), 116.0981, 5e-5);
  ExpectNear(network->NegativeStiffness(Eigen::Vector3d::Zero(), current)(0, 0),
             8 * kArea * kB0 * kB0 / (2 * kMu0 * kGap) * c * c);
}

TEST(PoleNetwork, WindingSignsOfECores) {
  StatorParameters p = Of("e-core");
  p.winding = "NNNN";
  EXPECT_NEAR(GainOfDifferentialDrive(p), 62.8319, 5e-5);
  EXPECT_NEAR(StiffnessAtBias(p)(0, 0), 314159, 0.5);
  StatorParameters alternating = Of("e-core");
  alternating.winding = "NS";
  ExpectNear(GainOfDifferentialDrive(alternating), 2 * GainOfDifferentialDrive(p));
  ExpectNear(StiffnessAtBias(alternating)(0, 0), 2 * StiffnessAtBias(p)(0, 0));
}

StatorParameters Homopolar(const std::string& coils) {
  StatorParameters p = Of("homopolar-pm");
  p.connection = coils;
  p.bias = {800, 4e-3, 6e-4, 1.05};
  return p;
}

TEST(PoleNetwork, HomopolarMagnet) {
  const auto network = NetworkOf(Homopolar("axis"));
  const Eigen::Vector2d none(0, 0);
  const PoleMatrix flux = network->FluxAt(Eigen::Vector3d::Zero()).phi;
  // One magnet, two rows of four gaps in series.
  const double gaps = 2 * kGap / (kMu0 * 4 * kArea), magnet = 4e-3 / (kMu0 * 1.05 * 6e-4);
  const double B0 = 800 / (gaps + magnet) / (4 * kArea);
  EXPECT_NEAR(B0, 0.170989, 5e-7);
  for (int k = 0; k < 8; ++k) ExpectNear(flux(k, 2) / kArea, k < 4 ? B0 : -B0);
  const auto J = network->ForceOfCurrent(Eigen::Vector3d::Zero(), none);
  ExpectNear(J(0, 0), 4 * kArea * B0 * kTurns / kGap);
  ExpectNear(J(1, 1), J(0, 0));
  EXPECT_NEAR(J(0, 0), 34.1979, 5e-5);
  EXPECT_NEAR(J(0, 1), 0, 1e-9);
  const Eigen::Matrix3d K = network->NegativeStiffness(Eigen::Vector3d::Zero(), none);
  ExpectNear(K(0, 0), 4 * kArea * B0 * B0 / (kMu0 * kGap));
  EXPECT_NEAR(K(0, 0), 46532.8, 0.05);
}

// Of three poles the first stands upright, at 90 deg: the second harmonic's direction shows where.
TEST(PoleNetwork, HomopolarForceIsLinearOfFourPolesAndNotOfThree) {
  const double B0 = 0.6, Bc = 0.2;
  for (const int n : {3, 4, 5, 6}) {
    std::vector<NetworkPole> poles;
    for (int k = 0; k < n; ++k) {
      NetworkPole p;
      p.direction = {std::cos(kPi / 2 + 2 * kPi * k / n), std::sin(kPi / 2 + 2 * kPi * k / n), 0};
      p.area = kArea;
      p.gap = kGap;
      poles.push_back(p);
    }
    const PoleNetwork network(poles, Eigen::MatrixXd::Ones(n, 1));
    const double phi = 10 * kPi / 180;
    PoleVector flux(n);
    for (int k = 0; k < n; ++k)
      flux[k] = kArea * (B0 + Bc * std::cos(kPi / 2 + 2 * kPi * k / n - phi));
    const Eigen::Vector3d f = network.Force(flux);
    const double linear = n * kArea * B0 * Bc / (2 * kMu0);
    if (n == 3) {
      EXPECT_NEAR(f.norm(), 27.532, 5e-4);
      EXPECT_NEAR(std::atan2(f.y(), f.x()) * 180 / kPi, 5.693, 5e-4);
      EXPECT_NEAR(linear, 28.648, 5e-4);
    } else {
      EXPECT_NEAR(f.x(), linear * std::cos(phi), 1e-9 * linear) << n;
      EXPECT_NEAR(f.y(), linear * std::sin(phi), 1e-9 * linear) << n;
    }
  }
}

TEST(PoleNetwork, UnbiasedThreePoles) {
  std::vector<NetworkPole> poles(3);
  PoleVector flux(3);
  const double Bc = 0.5, first = 0.3, phi = 1.1;
  for (int k = 0; k < 3; ++k) {
    const double angle = first + 2 * kPi * k / 3;
    poles[static_cast<std::size_t>(k)] = {{std::cos(angle), std::sin(angle), 0}, kArea, kGap};
    flux[k] = kArea * Bc * std::cos(angle - phi);
  }
  const Eigen::Vector3d f = PoleNetwork(poles, Eigen::MatrixXd::Ones(3, 1)).Force(flux);
  EXPECT_NEAR(f.norm(), 14.9208, 5e-5);
  EXPECT_NEAR(std::remainder(std::atan2(f.y(), f.x()) - (3 * first - 2 * phi), 2 * kPi), 0, 1e-9);
}

TEST(PoleNetwork, DoubleActingAxial) {
  const auto network = NetworkOf(Of("axial"));
  const Eigen::Vector2d bias(kBias, kBias);
  const auto J = network->ForceOfCurrent(Eigen::Vector3d::Zero(), bias);
  const double N2A = kMu0 * kTurns * kTurns * kArea;
  ExpectNear(J(0, 0) - J(0, 1), N2A * kBias / (kGap * kGap));
  ExpectNear(network->NegativeStiffness(Eigen::Vector3d::Zero(), bias)(0, 0),
             N2A * kBias * kBias / (kGap * kGap * kGap));
  EXPECT_NEAR(J(0, 0) - J(0, 1), 31.4159, 5e-5);
}

TEST(PoleNetwork, Cone) {
  StatorParameters p = Of("conical"), flat = Of("series-pairs");
  p.cone_deg = 10;
  const double c = std::cos(10 * kPi / 180), s = std::sin(10 * kPi / 180);
  ExpectNear(GainOfDifferentialDrive(p), GainOfDifferentialDrive(flat) * c);
  ExpectNear(StiffnessAtBias(p)(0, 0), StiffnessAtBias(flat)(0, 0) * c * c);
  EXPECT_NEAR(GainOfDifferentialDrive(p), 114.3343, 5e-5);
  EXPECT_NEAR(StiffnessAtBias(p)(0, 0), 609372, 0.5);
  const auto network = NetworkOf(p);
  const Eigen::Vector4d bias = Eigen::Vector4d::Constant(kBias);
  const double pull = network->Force(Eigen::Vector3d::Zero(), bias).z();
  EXPECT_NEAR(pull, 43.6425, 5e-5);
  ExpectNear(network->ForceOfCurrent(Eigen::Vector3d::Zero(), bias).row(2).sum(), 2 * pull / kBias);
  ExpectNear(StiffnessAtBias(p)(2, 2), 2 * pull * s / kGap);
  EXPECT_NEAR(StiffnessAtBias(p)(2, 2), 37892, 0.5);
}

// The eight-pole bearing of old, as a network, has the same inductances and forces off the centre.
TEST(PoleNetwork, AgreesWithTheEightPoleBearing) {
  RadialStatorParameters old;
  old.turns = 50;
  old.pole_area = kArea;
  old.gap = kGap;
  old.leakage_inductance = 3e-4;
  old.resistance = 0.5;
  old.winding = "NNSSNNSS";
  StatorParameters p = Of("one-coil-per-pole");
  p.turns = 50;
  p.pole_count = 8;
  p.winding = old.winding;
  const RadialStator stator(old);
  const auto network = NetworkOf(p);
  const CoilVector i = (CoilVector() << 2, 1, 0.5, 3, 2.2, 1.7, 0, 4).finished();
  const Eigen::Vector2d r(8e-5, -1.1e-4);
  const Eigen::Vector3d at(r.x(), r.y(), 0);
  const Eigen::Vector2d f = stator.Force(r, i), g = network->Force(at, i).head<2>();
  EXPECT_LT((f - g).norm(), 1e-12 * f.norm());
  const CoilMatrix L = stator.Inductance(r) - 3e-4 * CoilMatrix::Identity();
  const Eigen::MatrixXd M = network->Linkage(network->FluxAt(at).phi).leftCols(8);
  EXPECT_LT((L - M).cwiseAbs().maxCoeff(), 1e-12 * L.cwiseAbs().maxCoeff());
}

// dF/di = (dλ/dr)ᵀ, and all derivatives are those of the forces themselves, magnets and all.
TEST(PoleNetwork, DerivativesAreThoseOfTheForces) {
  for (const StatorParameters& p : {Homopolar("pole"), Of("e-core"), Of("one-coil-per-pole")}) {
    const auto network = NetworkOf(p);
    Eigen::VectorXd i(network->coils());
    for (int j = 0; j < i.size(); ++j) i[j] = 1 + 0.3 * std::sin(3.0 * j);
    const Eigen::Vector3d r(5e-5, -7e-5, 0);
    const auto J = network->ForceOfCurrent(r, i);
    const auto K = network->NegativeStiffness(r, i);
    EXPECT_LT((J - network->LinkageOfPlace(r, i).transpose()).norm(), 1e-11 * J.norm());
    const double di = 1e-4, dr = 1e-8;
    for (int j = 0; j < i.size(); ++j) {
      const Eigen::VectorXd step = di * Eigen::VectorXd::Unit(i.size(), j);
      const Eigen::Vector3d d =
          (network->Force(r, i + step) - network->Force(r, i - step)) / (2 * di);
      EXPECT_LT((d - J.col(j)).norm(), 1e-8 * J.norm());  // quadratic: exact but for rounding
    }
    for (int a = 0; a < 3; ++a) {
      const Eigen::Vector3d step = dr * Eigen::Vector3d::Unit(a);
      const Eigen::Vector3d d =
          (network->Force(r + step, i) - network->Force(r - step, i)) / (2 * dr);
      EXPECT_LT((d - K.col(a)).norm(), 1e-6 * K.norm());  // (dr/g)² and rounding
    }
  }
}

}  // namespace
}  // namespace ambrig
