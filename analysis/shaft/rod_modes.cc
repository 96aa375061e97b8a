#include "analysis/shaft/rod_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "rotor/shaft/beam_mesh.h"

namespace ambrig {

namespace {

using Eigen::MatrixXd;

/// Stiffness and mass per length of a rod's cross section.
struct RodSection {
  double stiffness = 0, mass = 0;
};

RodSection SectionOfRod(const ShaftElement& e, double t, bool torsion) {
  RodSection out;
  for (const ShaftSection& l : e.layers) {
    const double od = std::lerp(l.od, l.od_right, t), id = std::lerp(l.id, l.id_right, t);
    const double area =
        torsion ? kPi / 32 * (std::pow(od, 4) - std::pow(id, 4)) : kPi / 4 * (od * od - id * id);
    out.mass += l.material.rho * area;
    if (l.stiff) out.stiffness += (torsion ? l.material.shear_modulus() : l.material.E) * area;
  }
  return out;
}

/// K and M of one rod over (left, middle, right), Gauss-Legendre with five points.
void RodElement(const ShaftElement& e, bool torsion, Eigen::Matrix3d& K, Eigen::Matrix3d& M) {
  constexpr double kAt[3] = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr double kWeight[3] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  K.setZero();
  M.setZero();
  for (int k = -2; k <= 2; ++k) {
    const double r = (k < 0 ? -1 : 1) * kAt[std::abs(k)], w = kWeight[std::abs(k)] * e.length / 2;
    const RodSection s = SectionOfRod(e, 0.5 * (1 + r), torsion);
    const Eigen::Vector3d n(r * (r - 1) / 2, 1 - r * r, r * (r + 1) / 2);
    const Eigen::Vector3d slope = Eigen::Vector3d(r - 0.5, -2 * r, r + 0.5) * (2 / e.length);
    K += w * s.stiffness * slope * slope.transpose();
    M += w * s.mass * n * n.transpose();
  }
}

struct Rod {
  MatrixXd K, M;
};

Rod AssembleRod(const BeamRotor& beam, bool torsion, int more) {
  const Eigen::Index n = 2 * static_cast<Eigen::Index>(beam.elements.size()) + 1 + more;
  Rod rod{MatrixXd::Zero(n, n), MatrixXd::Zero(n, n)};
  for (std::size_t i = 0; i < beam.elements.size(); ++i) {
    if (beam.elements[i].layers.empty()) continue;  // a gap between shafts
    Eigen::Matrix3d K, M;
    RodElement(beam.elements[i], torsion, K, M);
    rod.K.block<3, 3>(2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(i)) += K;
    rod.M.block<3, 3>(2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(i)) += M;
  }
  for (const Disk& d : beam.disks) {
    const int at = 2 * NodeAt(beam, d.z);
    rod.M(at, at) += torsion ? d.inertia_polar : d.mass;
  }
  return rod;
}

std::vector<RodMode> SolveRod(const BeamRotor& beam, const Rod& rod, int count) {
  std::vector<Eigen::Index> kept;  // the middle of a gap between shafts is nothing
  for (Eigen::Index k = 0; k < rod.M.rows(); ++k)
    if (rod.M(k, k) != 0 || rod.K(k, k) != 0) kept.push_back(k);
  const MatrixXd K = rod.K(kept, kept), M = rod.M(kept, kept);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(K, M);
  if (eigen.info() != Eigen::Success)
    throw InputError(
        "the rotor's masses along its axis are not positive, allowed: added masses mzz of supports "
        "that leave them positive, a shaft with mass");
  std::vector<RodMode> out;
  const MatrixXd sizes = rod.K.cwiseAbs();
  for (Eigen::Index k = 0; k < K.rows() && static_cast<int>(out.size()) < count; ++k) {
    const double w2 = eigen.eigenvalues()(k);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(rod.M.rows());
    for (std::size_t i = 0; i < kept.size(); ++i)
      q(kept[i]) = eigen.eigenvectors()(static_cast<Eigen::Index>(i), k);
    // nothing is strained: a rigid motion
    if (w2 <= 0 || (rod.K * q).norm() < 1e-12 * (sizes * q.cwiseAbs()).norm()) continue;
    RodMode mode{std::sqrt(w2), {}};
    double peak = 0;
    for (std::size_t i = 0; i < beam.z.size(); ++i) {
      mode.shape.push_back(q(2 * static_cast<Eigen::Index>(i)));
      if (std::abs(mode.shape.back()) > std::abs(peak)) peak = mode.shape.back();
    }
    if (peak != 0)
      for (double& v : mode.shape) v /= peak;
    out.push_back(std::move(mode));
  }
  return out;
}

}  // namespace

std::vector<RodMode> AxialModes(const BeamRotor& beam, double speed, int count) {
  const Eigen::Index shaft = 2 * static_cast<Eigen::Index>(beam.elements.size()) + 1;
  std::vector<Eigen::Index> at;  // of the housings that have an axial mass
  Eigen::Index next = shaft;
  for (const Housing& h : beam.housings) at.push_back(h.mass_z > 0 ? next++ : -1);
  Rod rod = AssembleRod(beam, false, static_cast<int>(next - shaft));
  for (std::size_t k = 0; k < at.size(); ++k)
    if (at[k] >= 0) rod.M(at[k], at[k]) += beam.housings[k].mass_z;
  for (const PointMass& p : beam.masses)
    rod.M(2 * NodeAt(beam, p.z), 2 * NodeAt(beam, p.z)) += p.mass_z;
  const auto side = [&](const std::string& name, Eigen::Index otherwise) {
    for (std::size_t k = 0; k < beam.housings.size(); ++k)
      if (!name.empty() && beam.housings[k].name == name) return at[k];
    return otherwise;
  };
  for (const SpringSupport& s : beam.supports) {
    const SupportCoefficients c = s.At(speed);
    const Eigen::Index sides[2] = {
        side(s.carries, s.on_shaft() ? Eigen::Index{2 * NodeAt(beam, s.z)} : -1),
        side(s.on, s.between_shafts() ? Eigen::Index{2 * NodeAt(beam, s.to_z)} : -1)};
    for (int i : {0, 1})
      for (int j : {0, 1})
        if (sides[i] >= 0 && sides[j] >= 0) {
          rod.K(sides[i], sides[j]) += (i == j ? 1 : -1) * c.kzz;
          rod.M(sides[i], sides[j]) += (i == j ? 1 : -1) * c.mzz;
        }
  }
  return SolveRod(beam, rod, count);
}

std::vector<RodMode> TorsionalModes(const BeamRotor& beam, double speed, int count) {
  Rod rod = AssembleRod(beam, true, 0);
  for (const SpringSupport& s : beam.supports) {
    const double k = s.At(speed).krz;
    if (!s.on_shaft() || k == 0) continue;
    const int here = 2 * NodeAt(beam, s.z),
              there = s.between_shafts() ? 2 * NodeAt(beam, s.to_z) : -1;
    rod.K(here, here) += k;
    if (there < 0) continue;
    rod.K(there, there) += k;
    rod.K(here, there) -= k;
    rod.K(there, here) -= k;
  }
  return SolveRod(beam, rod, count);
}

}  // namespace ambrig
