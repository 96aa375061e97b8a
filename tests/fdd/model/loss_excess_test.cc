// What a small loss of turns makes of c, against the circuit of a thrust side solved with the turns
// that are left.
#include "fdd/model/loss_excess.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

/// Of a side whose first winding has lost the share `eps`: c of both windings by the full circuit,
/// when one voltage drives both.
Eigen::Vector2d ExcessOfSide(double mutual, double leakage, double eps) {
  const double left = 1 - eps;
  Eigen::Matrix2d true_L, model_L;
  true_L << left * left * (mutual + leakage), left * mutual, left * mutual, mutual + leakage;
  model_L << mutual + leakage, mutual, mutual, mutual + leakage;
  const Eigen::Vector2d voltage = Eigen::Vector2d::Ones(), slopes = true_L.inverse() * voltage;
  return model_L * slopes - voltage;
}

// The windings' currents part at once, as nothing but leakage holds them together: slopes to first
// order.
TEST(LossExcess, IsTheDerivativeOfTheCircuitOfAThrustSide) {
  ThrustStatorParameters p;
  p.turns = 80;
  p.pole_area = 4e-4;
  p.gap = 5e-4;
  LinkageModel m = MakeLinkageModel(p);
  for (const double share : {0.02, 0.1, 0.5, 2.0}) {
    const double mutual = m.n[0] * m.n[0] * m.Permeance(0, 0)[0], leakage = share * mutual;
    for (int j = 0; j < m.coils; ++j) m.leakage[j] = leakage;
    constexpr double kEps = 1e-7;
    const Eigen::Vector2d c = ExcessOfSide(mutual, leakage, kEps) / kEps;
    for (int j = 0; j < m.coils; ++j) {
      EXPECT_NEAR(ExcessOfLoss(m, j).own, c(0), 1e-4) << share;
      EXPECT_NEAR(ExcessOfLoss(m, j).partner, c(1), 1e-4) << share;
    }
  }
}

TEST(LossExcess, OfARadialCoilIsTwoAndReachesNoOther) {
  const LinkageModel m = MakeLinkageModel(testing_bench::Reference());
  EXPECT_EQ(ExcessOfLoss(m, 3).own, 2);
  EXPECT_EQ(ExcessOfLoss(m, 3).partner, 0);
}

}  // namespace
}  // namespace ambrig
