// The nonlinear program of a distribution: every derivative against differences of what it is the
// derivative of.
#include "faulttolerance/redistribution/distribution_program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/faulttolerance/redistribution_reference.h"

namespace ambrig {
namespace {

struct ProgramCase {
  int equations, quadrants;
  std::vector<int> failed;  // coils from 1
};

class DistributionDerivatives : public ::testing::TestWithParam<ProgramCase> {
 protected:
  void SetUp() override {
    problem_ = MakeRedistributionProblem(std::numbers::pi / 8, "NSNSNSNS");
    problem_.quadrants = GetParam().quadrants;
    for (const int coil : GetParam().failed) problem_.turns_left[coil - 1] = 0;
    problem_.turns_left[7] = 0.7;
    forms_ = MakeForceForms(problem_);
    program_ = std::make_unique<DistributionProgram>(
        problem_, forms_, GetParam().equations,
        DistributionProgram::Weights{1.3, 0.7, 0.4, 0.6, 2.1});
    program_->BoundCurrents(0.6);
    program_->BoundFluxes();
    x_.resize(program_->size());
    for (int k = 0; k < x_.size(); ++k) x_[k] = 0.8 * std::sin(1 + 2.3 * k) + 0.1 * k / 10;
  }

  /// (f(x + h e_k) - f(x - h e_k))/2h, whose error is h²/6 of the third derivative.
  template <class F>
  SmallMatrix Differences(F&& f) const {
    const double h = 1e-5;
    SmallMatrix out(f(x_).size(), x_.size());
    for (int k = 0; k < x_.size(); ++k) {
      SmallVector more = x_, less = x_;
      more[k] += h;
      less[k] -= h;
      out.col(k) = (f(more) - f(less)) / (2 * h);
    }
    return out;
  }

  RedistributionProblem problem_;
  ForceForms forms_;
  std::unique_ptr<DistributionProgram> program_;
  SmallVector x_;
};

// Third derivatives are of order 10 here, so that the differences err by 1e-9 and rounding by
// 1e-10.
constexpr double kAllowed = 1e-7;

TEST_P(DistributionDerivatives, GradientOfTheObjective) {
  const SmallMatrix slope = Differences([&](const SmallVector& x) -> SmallVector {
    return SmallVector::Constant(1, program_->Objective(x));
  });
  EXPECT_LT((slope.transpose() - program_->ObjectiveGradient(x_)).norm(), kAllowed * slope.norm());
}

TEST_P(DistributionDerivatives, JacobiansOfEquationsAndBounds) {
  const SmallMatrix equations =
      Differences([&](const SmallVector& x) { return program_->Equations(x); });
  EXPECT_LT((equations - program_->EquationJacobian(x_)).norm(), kAllowed * equations.norm());
  const SmallMatrix bounds = Differences([&](const SmallVector& x) { return program_->Bounds(x); });
  ASSERT_EQ(bounds.rows(), 2 * program_->live_count() + 16);
  EXPECT_LT((bounds - program_->BoundJacobian(x_)).norm(), kAllowed * bounds.norm());
}

TEST_P(DistributionDerivatives, HessianOfTheLagrangian) {
  SmallVector y(program_->equations()), z(program_->bounds());
  for (int k = 0; k < y.size(); ++k) y[k] = std::cos(1 + k);
  for (int k = 0; k < z.size(); ++k) z[k] = 0.5 + 0.4 * std::sin(2.0 * k);
  const auto gradient = [&](const SmallVector& x) -> SmallVector {
    return program_->ObjectiveGradient(x) - program_->EquationJacobian(x).transpose() * y -
           program_->BoundJacobian(x).transpose() * z;
  };
  const SmallMatrix bend = Differences(gradient), exact = program_->LagrangianHessian(x_, y, z);
  EXPECT_LT((bend - exact).norm(), kAllowed * bend.norm());
  EXPECT_LT((exact - exact.transpose()).norm(), 1e-12 * exact.norm());
}

TEST_P(DistributionDerivatives, AMatrixComesBackAsItWas) {
  const DistributionMatrix W = program_->ToMatrix(x_);
  for (const int coil : GetParam().failed) EXPECT_EQ(W.row(coil - 1).norm(), 0);
  const SmallVector back = program_->FromMatrix(W);
  const int w = 3 * program_->live_count();
  EXPECT_EQ((back.head(w) - x_.head(w)).norm(), 0);
  // T is large enough for its bounds; that a current is never negative does not hang on T.
  const SmallVector bounds = program_->Bounds(back);
  for (int k = 0; k < bounds.size(); ++k) {
    const bool sign = GetParam().quadrants == 2 && k < 2 * program_->live_count() && k % 2 == 1;
    if (!sign) {
      EXPECT_GE(bounds[k], -1e-12) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, DistributionDerivatives,
                         ::testing::Values(ProgramCase{12, 2, {}}, ProgramCase{6, 2, {3}},
                                           ProgramCase{12, 4, {1, 6}}, ProgramCase{6, 4, {}}),
                         [](const auto& of) {
                           return "Equations" + std::to_string(of.param.equations) + "Quadrants" +
                                  std::to_string(of.param.quadrants) + "Lost" +
                                  std::to_string(of.param.failed.size());
                         });

}  // namespace
}  // namespace ambrig
