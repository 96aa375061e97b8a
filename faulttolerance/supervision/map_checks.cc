#include "faulttolerance/supervision/map_checks.h"

#include "faulttolerance/redistribution/inverse_allocation.h"
#include "faulttolerance/redistribution/network_force.h"

namespace ambrig {

namespace {
constexpr double kTrueWithin = 0.15;  // of the force in command
// of the equations that a linearised W leaves open
constexpr double kTrueResidual = 1;
}  // namespace

bool GivesForce(const Eigen::Vector2d& force, const RedistributionProblem& left,
                const Distribution& found, const CurrentMap& map) {
  if (found.cls != SolvabilityClass::kLinearised) return found.cls == SolvabilityClass::kExact;
  if (found.residual > kTrueResidual) return false;
  return (NetworkForce(left).Force(map.SetPoints(force.x(), force.y())) - force).norm() <=
         kTrueWithin * force.norm();
}

Eigen::Matrix2d DestabilisingPart(const Eigen::Matrix2d& change) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen{Eigen::MatrixXd(change)};
  const Eigen::Matrix2d v = eigen.eigenvectors();
  const Eigen::Vector2d lambda = eigen.eigenvalues().cwiseMin(0.0);
  return v * lambda.asDiagonal() * v.transpose();
}

Eigen::Vector2d CommandedForce(const CurrentMap& map, const CoilVector& set_points) {
  if (map.allocation) return map.allocation->LastForce();
  const Eigen::Matrix<double, 8, 2> gain = map.W.rightCols<2>();
  const Eigen::Matrix2d normal = gain.transpose() * gain + 1e-9 * Eigen::Matrix2d::Identity();
  return map.k * map.c0 *
         (normal.inverse() * gain.transpose() * (set_points - map.c0 * map.W.col(0)));
}

CoilVector SetPointsOf(const BearingControl& control) {
  CoilVector out = CoilVector::Zero();
  for (int j = 0; j < control.coils; ++j) out[j] = control.set_point[j];
  return out;
}

}  // namespace ambrig
