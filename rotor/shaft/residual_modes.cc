#include "rotor/shaft/residual_modes.h"

#include "rotor/shaft/reduction.h"

namespace ambrig {

PlaneModes ResidualModes(const ReducedRotor& all, int kept, const std::vector<double>& stations) {
  const Eigen::Index left = all.modes() - kept;
  if (left <= 0 || stations.empty())
    return {Eigen::VectorXd(0), Eigen::MatrixXd(all.shape.rows(), 0)};
  const Eigen::VectorXd w2 =
      Eigen::Map<const Eigen::VectorXd>(all.omega.data(), all.modes()).tail(left).cwiseAbs2();
  // In coordinates of the dropped modes M = I and K = w2.
  Eigen::MatrixXd a(left, static_cast<Eigen::Index>(stations.size()));
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    a.col(j) = StationAt(all, stations[static_cast<std::size_t>(j)])
                   .phi.tail(left)
                   .cwiseQuotient(w2)
                   .normalized();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(Eigen::MatrixXd(a.transpose() * a));
  Eigen::Index alike = 0;  // two bearings at one plane
  while (alike < a.cols() && gram.eigenvalues()(alike) < 1e-8) ++alike;
  const Eigen::Index count = a.cols() - alike;
  const Eigen::MatrixXd basis =
      a * gram.eigenvectors().rightCols(count) *
      gram.eigenvalues().tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      Eigen::MatrixXd(basis.transpose() * w2.asDiagonal() * basis));
  return {eigen.eigenvalues().cwiseSqrt(),
          all.shape.rightCols(left) * (basis * eigen.eigenvectors())};
}

}  // namespace ambrig
