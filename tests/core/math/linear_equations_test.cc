// Solutions of linear equations by what defines them: residuals, normal equations, Penrose's
// conditions.
#include "core/math/linear_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <complex>
#include <limits>
#include <random>

namespace ambrig {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

Eigen::MatrixXd Drawn(int rows, int columns, unsigned seed = 3) {
  std::mt19937_64 draw(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd a(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) a(i, j) = normal(draw);
  return a;
}

Eigen::MatrixXcd DrawnComplex(int rows, int columns) {
  return Drawn(rows, columns, 4) + std::complex<double>(0, 1) * Drawn(rows, columns, 5);
}

/// Backward error of an elimination with n rows, with a growth of the pivots of 10.
double Allowed(Eigen::Index n) { return 10 * static_cast<double>(n) * kEps; }

TEST(LinearEquations, EliminationLeavesTheResidualOfRounding) {
  for (const int n : {1, 4, 17, 60}) {
    const Eigen::MatrixXd A = Drawn(n, n), B = Drawn(n, 3, 8);
    const Eigen::VectorXd b = B.col(0), x = SolveLinear(A, b);
    const Eigen::MatrixXd X = SolveLinearColumns(A, B);
    EXPECT_LE((A * x - b).norm(), Allowed(n) * A.norm() * x.norm()) << n;
    EXPECT_LE((A * X - B).norm(), Allowed(n) * A.norm() * X.norm()) << n;
    EXPECT_LE((A * InverseOf(A) - Eigen::MatrixXd::Identity(n, n)).norm(),
              Allowed(n) * A.norm() * InverseOf(A).norm())
        << n;
  }
}

TEST(LinearEquations, ComplexOnesToo) {
  for (const int n : {1, 5, 30}) {
    const Eigen::MatrixXcd A = DrawnComplex(n, n), B = DrawnComplex(n, 2);
    const Eigen::VectorXcd b = B.col(1), x = SolveComplex(A, b);
    const Eigen::MatrixXcd X = SolveComplexColumns(A, B);
    EXPECT_LE((A * x - b).norm(), Allowed(n) * A.norm() * x.norm()) << n;
    EXPECT_LE((A * X - B).norm(), Allowed(n) * A.norm() * X.norm()) << n;
    EXPECT_LE((A * ComplexInverseOf(A) - Eigen::MatrixXcd::Identity(n, n)).norm(),
              Allowed(n) * A.norm() * ComplexInverseOf(A).norm())
        << n;
  }
}

TEST(LinearEquations, SymmetricOnesReadTheLowerTriangleOnly) {
  const int n = 12;
  const Eigen::MatrixXd root = Drawn(n, n);
  const Eigen::MatrixXd A = root * root.transpose(), B = Drawn(n, 4, 9);
  Eigen::MatrixXd lower = A;
  lower.triangularView<Eigen::StrictlyUpper>().setConstant(7);
  const Eigen::VectorXd b = B.col(2), x = SolveSymmetric(lower, b);
  const Eigen::MatrixXd X = SolveSymmetricColumns(lower, B);
  EXPECT_LE((A * x - b).norm(), Allowed(n) * A.norm() * x.norm());
  EXPECT_LE((A * X - B).norm(), Allowed(n) * A.norm() * X.norm());
}

TEST(LinearEquations, PseudoinverseMeetsPenrosesConditions) {
  for (const auto& [rows, columns, rank] :
       {std::array{6, 2, 2}, {2, 6, 2}, {5, 5, 5}, {7, 6, 3}, {4, 9, 1}}) {
    const Eigen::MatrixXd A = Drawn(rows, rank) * Drawn(rank, columns, 11);
    const Eigen::MatrixXd P = PseudoinverseOf(A);
    ASSERT_EQ(P.rows(), columns);
    ASSERT_EQ(P.cols(), rows);
    const double allowed = Allowed(rows + columns) * A.norm() * P.norm();
    EXPECT_LE((A * P * A - A).norm(), allowed * A.norm()) << rows << columns << rank;
    EXPECT_LE((P * A * P - P).norm(), allowed * P.norm()) << rows << columns << rank;
    EXPECT_LE((A * P - (A * P).transpose()).norm(), allowed) << rows << columns << rank;
    EXPECT_LE((P * A - (P * A).transpose()).norm(), allowed) << rows << columns << rank;
  }
}

TEST(LinearEquations, LeastNormIsTheShortestOfTheBest) {
  const Eigen::MatrixXd A = Drawn(5, 2) * Drawn(2, 7, 12);  // rank 2
  const Eigen::VectorXd b = Drawn(5, 1, 13), x = SolveLeastNorm(A, b);
  const double size = A.norm() * A.norm() * x.norm();
  EXPECT_LE((A.transpose() * (A * x - b)).norm(), Allowed(12) * size);  // none is nearer
  EXPECT_LE(
      (x - PseudoinverseOf(A) * (A * x)).norm(),
      Allowed(12) * A.norm() * PseudoinverseOf(A).norm() * x.norm());  // no part that A maps to 0
  EXPECT_GT(x.norm(), 0.01);
}

TEST(LinearEquations, LeastSquaresLeaveAResidualAcrossTheColumns) {
  const Eigen::MatrixXd A = Drawn(40, 5);
  const Eigen::VectorXd b = Drawn(40, 1, 14), x = SolveLeastSquares(A, b);
  EXPECT_LE((A.transpose() * (A * x - b)).norm(), Allowed(40) * A.norm() * b.norm());
  EXPECT_GT((A * x - b).norm(), 1);  // b is not in the span, so that the condition says something
}

TEST(LinearEquations, OrthonormalColumnsSpanTheSame) {
  const Eigen::MatrixXd A = Drawn(30, 4), Q = OrthonormalColumnsOf(A);
  ASSERT_EQ(Q.cols(), 4);
  EXPECT_LE((Q.transpose() * Q - Eigen::MatrixXd::Identity(4, 4)).norm(), Allowed(30));
  EXPECT_LE((A - Q * (Q.transpose() * A)).norm(), Allowed(30) * A.norm());
}

}  // namespace
}  // namespace ambrig
