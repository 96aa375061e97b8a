// Inductances of the detector's circuit against the closed form of the stator and by hand.
#include "fdd/circuit/inductance_matrix.h"

#include <gtest/gtest.h>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

TEST(InductanceMatrix, OfARadialBearingIsThatOfItsStator) {
  const LinkageModel m = MakeLinkageModel(Reference());
  const RadialStator stator(Reference());
  for (const Eigen::Vector2d& r : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1.2e-4, -5e-5)}) {
    const LinkageMatrix L = InductanceOf(m, m.Permeance(r.x(), r.y()));
    EXPECT_LT((L - stator.Inductance(r)).norm(), 1e-12 * L.norm());
    EXPECT_LT((L - L.transpose()).norm(), 1e-15);
  }
}

ThrustStatorParameters ThrustDisk() {
  ThrustStatorParameters p;
  p.turns = 80;
  p.pole_area = 4e-4;
  p.gap = 5e-4;
  p.leakage_inductance = 3e-4;
  p.resistance = 0.6;
  p.bias_current = 1.5;
  return p;
}

// Two windings on a core: N² P each and between them; nothing from one side to the other.
TEST(InductanceMatrix, OfAThrustBearingCouplesTheWindingsOfASide) {
  const ThrustStatorParameters p = ThrustDisk();
  const LinkageModel m = MakeLinkageModel(p);
  const double z = 1e-4;
  const LinkageMatrix L = InductanceOf(m, m.Permeance(z, 0));
  const double near = 80 * 80 * kMu0 * 4e-4 / (2 * (5e-4 - z)),
               far = 80 * 80 * kMu0 * 4e-4 / (2 * (5e-4 + z));
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k) {
      const double mutual = j / 2 != k / 2 ? 0 : j < 2 ? near : far;
      EXPECT_NEAR(L(j, k), mutual + (j == k ? 3e-4 : 0), 1e-12) << j << k;
    }
  // Lanes without a coil are harmless.
  EXPECT_EQ((L.bottomRightCorner<4, 4>()), (Eigen::Matrix4d::Identity()));
  EXPECT_EQ((L.topRightCorner<4, 4>()), (Eigen::Matrix4d::Zero()));
}

TEST(InductanceMatrix, OfOpposedMagnetsIsDiagonal) {
  OpposedStatorParameters p;
  p.gap = 0.014;
  p.inductance_far = 0.1;
  p.inductance_near = 0.05;
  p.gap_constant = 0.01;
  p.resistance = 4;
  const LinkageModel m = MakeLinkageModel(p);
  const double x = 2e-3;
  const LinkageMatrix L = InductanceOf(m, m.Permeance(x, 0));
  EXPECT_NEAR(L(0, 0), 0.1 + 0.05 / (1 + (0.014 - x) / 0.01), 1e-12);
  EXPECT_NEAR(L(1, 1), 0.1 + 0.05 / (1 + (0.014 + x) / 0.01), 1e-12);
  EXPECT_EQ(L(0, 1), 0);
}

TEST(MovingInverse, GoesFromOneInverseToTheOther) {
  const LinkageModel m = MakeLinkageModel(Reference());
  MeasuredPeriod in;
  in.x0 = -3e-5;
  in.y0 = 1e-5;
  in.x1 = 6e-5;
  in.y1 = 4e-5;
  const MovingInverse moving(m, in);
  const LinkageMatrix first = InductanceOf(m, m.Permeance(in.x0, in.y0)),
                      last = InductanceOf(m, m.Permeance(in.x1, in.y1));
  EXPECT_LT((moving.At(0, 18) * first - LinkageMatrix::Identity()).norm(), 1e-10);
  EXPECT_LT((moving.At(18, 18) * last - LinkageMatrix::Identity()).norm(), 1e-10);
  EXPECT_LT((moving.At(9, 18) - 0.5 * (first.inverse() + last.inverse())).norm(),
            1e-12 * moving.start.norm());
}

// Over all samples the bridge gives its mean voltage times the period, whatever sample holds the
// edge.
TEST(DrivenLinkage, OfAllSamplesIsTheMeanVoltage) {
  Bench bench;
  const SamplingSettings s = bench.Sampling();
  Lane duty;
  for (int j = 0; j < kLanes; ++j) duty[j] = 0.05 + 0.11 * j;
  MeasuredPeriod in;
  in.duty = &duty;
  in.bus = 28.5;
  for (int j = 0; j < kLanes; ++j) {
    double sum = 0, least = 1, most = -1;
    for (int k = 0; k < kSamples; ++k) {
      const double part = DrivenLinkage(s, in, j, k);
      sum += part;
      least = std::min(least, part / s.step);
      most = std::max(most, part / s.step);
    }
    const double on = 28.5 - 2 * 0.125, off = -28.5 - 2 * 0.7;
    EXPECT_NEAR(sum, kT * (duty[j] * on + (1 - duty[j]) * off), 1e-12);
    EXPECT_NEAR(least, off, 1e-9);
    if (duty[j] * kSamples >= 1) {
      EXPECT_NEAR(most, on, 1e-9);
    }
  }
}

}  // namespace
}  // namespace ambrig
