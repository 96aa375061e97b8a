#include "faulttolerance/redistribution/force_forms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/math/constants.h"
#include "tests/faulttolerance/redistribution_reference.h"

namespace ambrig {
namespace {

using std::numbers::pi;
using testing_reference::DirectForce;

RedistributionProblem ProblemWith(const char* winding = "NSNSNSNS") {
  return MakeRedistributionProblem(pi / 8, winding);
}

/// W whose row j carries `mmf` row j: i_j = s_j m_j.
DistributionMatrix FromMmf(const RedistributionProblem& p, const DistributionMatrix& mmf) {
  return p.sign.asDiagonal() * mmf;
}

double Residual(const RedistributionProblem& p, const DistributionMatrix& W) {
  return EquationErrors(MakeForceForms(p), W).cwiseAbs().maxCoeff();
}

TEST(ForceForms, ReferenceRigHasTheNumbersOfTheDesign) {
  const RedistributionProblem p = ProblemWith();
  EXPECT_NEAR(ForceFactor(p) * 9, 144, 0.01);  // published_values.md 2.3: capacity 1 is 144 N
  const DistributionMatrix W = HealthyDistribution(p);
  EXPECT_LT(Residual(p, W), 1e-15);
  // K = k c0^2 / g0 (published_values.md 2.1, ks = 4 kappa i0^2 / g0) in both directions: 1.6e5
  // N/m.
  const double K = ForceFactor(p) * 4 / p.gap;
  EXPECT_LT((NegativeStiffness(p, MakeForceForms(p), W) / K - Eigen::Matrix2d::Identity()).norm(),
            1e-14);
  EXPECT_DOUBLE_EQ(WorkingDisc(p, W), 1);
  EXPECT_NEAR(CurrentCapacity(p, W), 1, 1e-15);
  EXPECT_NEAR(FluxCapacity(MakeForceForms(p), W), 1, 1e-15);
}

TEST(ForceForms, FormsAreTheFluxForce) {
  const RedistributionProblem p = ProblemWith("NNSSNNSS");
  const ForceForms forms = MakeForceForms(p);
  const double half_k = ForceFactor(p) / 2;
  for (int n = 0; n < 20; ++n) {
    const CoilVector i = CoilVector::Random() * 5;
    const Eigen::Vector2d f = DirectForce(p, i, {0, 0});
    for (int axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(half_k * i.dot(forms.Q[axis] * i), f[axis], 1e-12 * half_k * i.squaredNorm());
  }
}

TEST(ForceForms, StiffnessIsTheDerivativeOfTheForce) {
  RedistributionProblem p = ProblemWith();
  p.turns_left[2] = 0.6;
  const DistributionMatrix W = DistributionMatrix::Random();
  const CoilVector bias = p.c0 * W.col(0);
  const Eigen::Matrix2d K = NegativeStiffness(p, MakeForceForms(p), W);
  const double h = 1e-4 * p.gap;  // central difference: error (h/g)^2 = 1e-8 of the scale
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d d = h * Eigen::Vector2d::Unit(axis);
    const Eigen::Vector2d slope = (DirectForce(p, bias, d) - DirectForce(p, bias, -d)) / (2 * h);
    EXPECT_LT((slope - K.col(axis)).norm(), 1e-6 * K.norm());
  }
}

// docs/theory/published_values.md 2.1, closed forms 2 to 4.
TEST(ForceForms, SingleCoilByShiftingAllCurrents) {
  const RedistributionProblem healthy = ProblemWith();
  const DistributionMatrix mmf = healthy.sign.asDiagonal() * HealthyDistribution(healthy);
  for (int f = 0; f < 8; ++f) {
    RedistributionProblem p = healthy;
    p.turns_left[f] = 0;
    const DistributionMatrix shifted = mmf - CoilVector::Ones() * mmf.row(f);
    const DistributionMatrix W = FromMmf(p, shifted);
    EXPECT_LT(Residual(p, W), 1e-15);
    EXPECT_NEAR(W.col(0).squaredNorm(), 16, 1e-12);  // copper loss of the bias doubles
    EXPECT_EQ(UnipolarDisc(p, W), 0);                // and the closed form clips
    EXPECT_LT((NegativeStiffness(p, MakeForceForms(p), W) -
               NegativeStiffness(healthy, MakeForceForms(healthy), HealthyDistribution(healthy)))
                  .norm(),
              1e-6);
  }
}

TEST(ForceForms, AdjacentPair) {
  RedistributionProblem p = ProblemWith("NNSSNNSS");
  p.turns_left[0] = p.turns_left[1] = 0;
  DistributionMatrix pattern;
  pattern << 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0;
  // F = (cos 22.5 + sin 22.5) kappa i0 i instead of 4 kappa i0 i: controls larger by the ratio.
  const double ratio = 4 / (std::cos(pi / 8) + std::sin(pi / 8));
  pattern.rightCols(2) *= ratio;
  // The signs of the bias are those of the fluxes; the source leaves open which pattern, the
  // control columns carry their own.
  double best = 1;
  for (int signs = 0; signs < 256; ++signs) {
    DistributionMatrix W = pattern;
    for (int j = 0; j < 8; ++j)
      if (signs >> j & 1) W.row(j) *= -1;
    best = std::min(best, Residual(p, W));
  }
  EXPECT_LT(best, 1e-14);
}

TEST(ForceForms, AlternateFour) {
  RedistributionProblem p = ProblemWith();
  DistributionMatrix mmf = DistributionMatrix::Zero();
  for (int j = 0; j < 8; ++j) {
    if (j % 2 == 1) {
      p.turns_left[j] = 0;
      continue;
    }
    // The live poles lie at 22.5 + 90 m degrees: bias +,-,+,-; controls push opposite pairs.
    const double sign = j % 4 == 0 ? 1 : -1;
    mmf(j, 0) = sign;
    mmf(j, 1) = sign * 2 * std::cos(p.angle[j]);
    mmf(j, 2) = sign * 2 * std::sin(p.angle[j]);
  }
  EXPECT_LT(Residual(p, FromMmf(p, mmf)), 1e-14);
  EXPECT_NEAR(FluxCapacity(MakeForceForms(p), FromMmf(p, mmf)), 0.5, 1e-12);
}

TEST(ForceForms, OracleMatricesSolveTheEquations) {
  std::ifstream stream(std::string(AMBRIG_SOURCE_DIR) + "/tests/faulttolerance/gbcl_oracles.json");
  const nlohmann::json root = nlohmann::json::parse(stream);
  int count = 0;
  for (const auto& [name, item] : root.at("sets").items()) {
    RedistributionProblem p = ProblemWith();
    for (const int coil : nlohmann::json::parse(name)) p.turns_left[coil - 1] = 0;
    DistributionMatrix mmf;
    for (int j = 0; j < 8; ++j)
      for (int c = 0; c < 3; ++c) mmf(j, c) = item.at("W").at(j).at(c).get<double>();
    // Its gain is 2 sum B_b B_w e = 1 where ours is 8: both columns times sqrt(8).
    const DistributionMatrix W = FromMmf(p, mmf * std::sqrt(8.0));
    EXPECT_LT(Residual(p, W), 1e-10) << name;  // 12 digits are printed
    const double t = item.at("t").get<double>();
    // 0.5/t^2 is the capacity with the file's own bias scale; the best scale can only be better.
    EXPECT_GT(FluxCapacity(MakeForceForms(p), W), 0.5 / (t * t) * (1 - 1e-6)) << name;
    ++count;
  }
  EXPECT_EQ(count, 13);
}

TEST(ForceForms, CapacityIsTheBestOverBiasScales) {
  const RedistributionProblem p = ProblemWith();
  DistributionMatrix W = HealthyDistribution(p);
  W.col(0).head(3) *= 1.7;  // no solution of the equations, only a shape
  double best = 0;
  for (int n = 1; n <= 20000; ++n) {
    const double t = n * 1e-4;
    double peak = 0;
    bool inside = true;
    for (int j = 0; j < 8; ++j) {
      const double w = t * W.row(j).tail<2>().norm();
      peak = std::max(peak, W(j, 0) + w);
      inside &= W(j, 0) >= w - 1e-12;
    }
    if (inside) best = std::max(best, 4 * t / (peak * peak));
  }
  EXPECT_NEAR(CurrentCapacity(p, W), best, 1e-4 * best);  // the scan's step
}

// The angles and signs are those of the drawing: pole j at first + (j-1) 45 degrees, N is +1.
TEST(RedistributionProblem, HasTheDrawingsAnglesAndWinding) {
  const RedistributionProblem p = MakeRedistributionProblem(0.3, "NNSSNSNS");
  const double sign[8] = {1, 1, -1, -1, 1, -1, 1, -1};
  for (int j = 0; j < 8; ++j) {
    EXPECT_NEAR(std::remainder(p.angle[j] - (0.3 + j * pi / 4), 2 * pi), 0, 1e-14);
    EXPECT_EQ(p.sign[j], sign[j]);
    EXPECT_EQ(p.turns_left[j], 1);
  }
  EXPECT_EQ(p.turns, 50);
  EXPECT_EQ(p.pole_area, 2.0372e-4);
  EXPECT_EQ(p.gap, 4e-4);
}

// The six pairs of columns, each for both axes, in their order: bias alone, gains, then what grows
// with |v|².
TEST(ForceForms, ErrorsAreThoseOfEveryPairOfColumns) {
  const ForceForms forms = MakeForceForms(ProblemWith());
  DistributionMatrix W;
  for (int j = 0; j < 8; ++j)
    for (int c = 0; c < 3; ++c) W(j, c) = std::sin(1.7 * j + 2.3 * c + 0.4);
  const auto form = [&](int p, int q, int axis) { return W.col(p).dot(forms.Q[axis] * W.col(q)); };
  const auto errors = EquationErrors(forms, W);
  const int p[] = {0, 0, 0, 1, 1, 2}, q[] = {0, 1, 2, 1, 2, 2};
  for (int pair = 0; pair < 6; ++pair)
    for (int axis = 0; axis < 2; ++axis) {
      const bool gain = p[pair] == 0 && q[pair] == axis + 1;
      EXPECT_NEAR(errors[2 * pair + axis], form(p[pair], q[pair], axis) - (gain ? 1 : 0), 1e-13)
          << pair << " " << axis;
    }
  EXPECT_GT(std::abs(form(1, 1, 0) - form(1, 2, 0)), 0.01);  // the pairs differ
}

}  // namespace
}  // namespace ambrig
