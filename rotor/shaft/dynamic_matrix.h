#pragma once
/// lambda² M + lambda (D + Omega G) + K of a rotor at one speed, sparse: solved in a time that
/// grows with the number of nodes, not with its cube. lambda [1/s]; i Omega for what turns
/// with the shaft.
#include <Eigen/SparseCore>
#include <complex>
#include <memory>

#include "rotor/linear/linear_rotor.h"

namespace ambrig {

class DynamicMatrix {
 public:
  DynamicMatrix(const LinearRotor& rotor, double speed);
  /// lambda² M + lambda C + K of any three.
  DynamicMatrix(const Eigen::MatrixXcd& M, const Eigen::MatrixXcd& C, const Eigen::MatrixXcd& K);
  ~DynamicMatrix();

  /// False where the matrix is singular.
  bool Factorise(std::complex<double> lambda);
  /// By the last factors.
  Eigen::MatrixXcd Solve(const Eigen::MatrixXcd& right) const;
  /// (2 lambda M + D + Omega G) q: the matrix's derivative along lambda.
  Eigen::VectorXcd Slope(std::complex<double> lambda, const Eigen::VectorXcd& q) const;

 private:
  struct Factors;
  Eigen::SparseMatrix<std::complex<double>> M_, C_, K_, sum_;  // of one pattern
  std::unique_ptr<Factors> factors_;
};

}  // namespace ambrig
