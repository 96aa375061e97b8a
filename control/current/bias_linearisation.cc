#include "control/current/bias_linearisation.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"

namespace ambrig {

namespace {

/// Current that makes the magnets' mean flux density in the wound poles [A].
double EquivalentCurrent(const PoleNetwork& network) {
  const PoleMatrix per = network.FluxAt(Eigen::Vector3d::Zero()).phi;
  double sum = 0, count = 0;
  for (int p = 0; p < network.poles(); ++p) {
    const double turns = network.turns().row(p).cwiseAbs().maxCoeff();
    if (turns == 0) continue;
    const NetworkPole& pole = network.pole(p);
    sum += std::abs(per(p, network.coils())) * pole.gap / (pole.area * kMu0 * turns);
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

/// What every pole would pull if nothing cancelled, over the current: a scale for rounding [N/A].
double PullOfAllMagnetomotiveForces(const PoleNetwork& network, double current) {
  double pull = 0;
  for (int p = 0; p < network.poles(); ++p) {
    const NetworkPole& pole = network.pole(p);
    const double field = kMu0 * network.turns().row(p).cwiseAbs().sum() * current / pole.gap;
    pull += field * field * pole.area / (2 * kMu0);
  }
  return pull / current;
}

constexpr double kNoForce = 1e-9;  // of that: rounding

}  // namespace

BiasLinearisation LineariseAtBias(const PoleNetwork& network, double bias, int axes) {
  const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const Eigen::VectorXd current = Eigen::VectorXd::Constant(network.coils(), bias);
  BiasLinearisation out;
  out.bias_force = network.Force(centre, current);
  out.W = Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(network.coils(), 3);
  out.c0 = network.has_magnets() ? std::max(EquivalentCurrent(network), bias) : bias;
  const Eigen::MatrixXd J = network.ForceOfCurrent(centre, current).topRows(axes);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd s = svd.singularValues();
  if (out.c0 <= 0 || s.size() < axes ||
      !(s[axes - 1] > kNoForce * PullOfAllMagnetomotiveForces(network, out.c0)))
    return out;
  out.condition = s[axes - 1] / s[0];
  const Eigen::MatrixXd inverse =
      svd.matrixV() * s.cwiseInverse().asDiagonal() * svd.matrixU().transpose();
  const double gain = 1 / inverse.rowwise().norm().maxCoeff();  // k c0 [N/A]
  out.k = gain / out.c0;
  out.W.col(0).setConstant(bias / out.c0);
  out.W.middleCols(1, axes) = gain * inverse;
  return out;
}

}  // namespace ambrig
