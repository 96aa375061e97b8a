#include "actuators/magnetics/pole_network.h"

#include <algorithm>
#include <utility>

#include "actuators/magnetics/gap_reluctance.h"
#include "core/base/errors.h"
#include "core/base/parameters.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

constexpr int kMostParts = 4;

using PartMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostParts, kMostParts>;
using PartSources =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostParts, kMostWindings + 1>;

}  // namespace

PoleNetwork::PoleNetwork(std::vector<NetworkPole> poles, Eigen::MatrixXd turns,
                         std::vector<NetworkMagnet> magnets)
    : poles_(std::move(poles)),
      turns_(std::move(turns)),
      turns_of_(turns_.cwiseAbs().colwise().sum()),
      magnets_(std::move(magnets)) {
  Require(!poles_.empty() && poles_.size() <= kMostPoles, "1 to 32 poles");
  Require(turns_.rows() == static_cast<Eigen::Index>(poles_.size()), "a row of turns per pole");
  Require(turns_.cols() >= 1 && turns_.cols() <= kMostWindings, "1 to 24 coils");
  for (const NetworkPole& p : poles_) {
    Require(p.area > 0 && p.gap > 0 && p.part >= 0, "a pole with area and gap");
    parts_ = std::max(parts_, p.part + 1);
    has_magnets_ = has_magnets_ || p.mmf != 0;
  }
  Require(parts_ <= kMostParts, "at most 4 parts");
  for (const NetworkMagnet& m : magnets_) {
    Require(m.from >= 0 && m.from < parts_ && m.to < parts_ && m.to != m.from && m.reluctance > 0,
            "a magnet between parts that have poles");
    has_magnets_ = has_magnets_ || m.mmf != 0;
  }
}

double PoleNetwork::SmallestGap() const {
  double least = kInfinity;
  for (const NetworkPole& p : poles_) least = std::min(least, p.gap);
  return least;
}

NetworkFlux PoleNetwork::FluxAt(const Eigen::Vector3d& r, bool derivatives) const {
  const Eigen::Index n = poles(), columns = turns_.cols() + 1;
  PoleVector P(n), slope(n);  // permeance; (dP/P) per metre of closing
  PartMatrix Y = PartMatrix::Zero(parts_, parts_);
  PartSources s = PartSources::Zero(parts_, columns);
  PoleMatrix m(n, columns);
  m.leftCols(columns - 1) = turns_;
  for (Eigen::Index k = 0; k < n; ++k) {
    const NetworkPole& p = poles_[static_cast<std::size_t>(k)];
    const Eigen::Vector3d d(p.direction[0], p.direction[1], p.direction[2]);
    const double per_metre = 1 / (kMu0 * p.area), free = p.gap - d.dot(r);
    const double gap = std::max(free, kGapAtPole * p.gap);
    P[k] = 1 / (per_metre * gap + p.reluctance);
    slope[k] = free == gap ? per_metre * P[k] : 0;
    m(k, columns - 1) = p.mmf;
    Y(p.part, p.part) += P[k];
    s.row(p.part) -= P[k] * m.row(k);
  }
  for (const NetworkMagnet& magnet : magnets_) {
    const double G = 1 / magnet.reluctance, flux = G * magnet.mmf;
    Y(magnet.from, magnet.from) += G;
    s(magnet.from, columns - 1) -= flux;
    if (magnet.to == NetworkMagnet::kRotor) continue;
    Y(magnet.to, magnet.to) += G;
    Y(magnet.from, magnet.to) -= G;
    Y(magnet.to, magnet.from) -= G;
    s(magnet.to, columns - 1) += flux;
  }
  const Eigen::LDLT<PartMatrix> inverse(Y);
  const PartSources U = inverse.solve(s);
  NetworkFlux out;
  out.phi.resize(n, columns);
  const auto part = [&](Eigen::Index k) { return poles_[static_cast<std::size_t>(k)].part; };
  for (Eigen::Index k = 0; k < n; ++k) out.phi.row(k) = P[k] * (m.row(k) + U.row(part(k)));
  for (std::size_t axis = 0; derivatives && axis < 3; ++axis) {
    // dphi_p = (dP/P) phi_p + P dU, and these again leave every part with sum zero.
    PartSources ds = PartSources::Zero(parts_, columns);
    PoleMatrix d(n, columns);
    for (Eigen::Index k = 0; k < n; ++k) {
      d.row(k) = slope[k] * poles_[static_cast<std::size_t>(k)].direction[axis] * out.phi.row(k);
      ds.row(part(k)) -= d.row(k);
    }
    const PartSources dU = inverse.solve(ds);
    for (Eigen::Index k = 0; k < n; ++k) d.row(k) += P[k] * dU.row(part(k));
    out.d[axis] = d;
  }
  return out;
}

Eigen::Vector3d PoleNetwork::Force(const PoleVector& phi) const {
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < phi.size(); ++k) {
    const NetworkPole& p = poles_[static_cast<std::size_t>(k)];
    const double pull = phi[k] * phi[k] / (2 * kMu0 * p.area);
    for (int a = 0; a < 3; ++a) f[a] += pull * p.direction[static_cast<std::size_t>(a)];
  }
  return f;
}

namespace {

PoleVector Fluxes(const PoleMatrix& phi, const Eigen::VectorXd& current) {
  return phi.leftCols(phi.cols() - 1) * current + phi.col(phi.cols() - 1);
}

}  // namespace

Eigen::Vector3d PoleNetwork::Force(const Eigen::Vector3d& r, const Eigen::VectorXd& current) const {
  return Force(Fluxes(FluxAt(r).phi, current));
}

Eigen::Matrix<double, 3, Eigen::Dynamic> PoleNetwork::ForceOfCurrent(
    const Eigen::Vector3d& r, const Eigen::VectorXd& current) const {
  const PoleMatrix per = FluxAt(r).phi;
  const PoleVector phi = Fluxes(per, current);
  Eigen::Matrix<double, 3, Eigen::Dynamic> J =
      Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, coils());
  for (Eigen::Index k = 0; k < phi.size(); ++k) {
    const NetworkPole& p = poles_[static_cast<std::size_t>(k)];
    for (int a = 0; a < 3; ++a)
      J.row(a) += phi[k] / (kMu0 * p.area) * p.direction[static_cast<std::size_t>(a)] *
                  per.row(k).head(coils());
  }
  return J;
}

Eigen::Matrix3d PoleNetwork::NegativeStiffness(const Eigen::Vector3d& r,
                                               const Eigen::VectorXd& current) const {
  const NetworkFlux flux = FluxAt(r, true);
  const PoleVector phi = Fluxes(flux.phi, current);
  Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PoleVector change = Fluxes(flux.d[axis], current);
    for (Eigen::Index k = 0; k < phi.size(); ++k) {
      const NetworkPole& p = poles_[static_cast<std::size_t>(k)];
      for (int a = 0; a < 3; ++a)
        K(a, static_cast<Eigen::Index>(axis)) +=
            phi[k] * change[k] / (kMu0 * p.area) * p.direction[static_cast<std::size_t>(a)];
    }
  }
  return K;
}

WindingMatrix PoleNetwork::Linkage(const PoleMatrix& phi) const { return turns_.transpose() * phi; }

Eigen::Matrix<double, Eigen::Dynamic, 3> PoleNetwork::LinkageOfPlace(
    const Eigen::Vector3d& r, const Eigen::VectorXd& current) const {
  const NetworkFlux flux = FluxAt(r, true);
  Eigen::Matrix<double, Eigen::Dynamic, 3> out(coils(), 3);
  for (std::size_t axis = 0; axis < 3; ++axis)
    out.col(static_cast<Eigen::Index>(axis)) = turns_.transpose() * Fluxes(flux.d[axis], current);
  return out;
}

}  // namespace ambrig
