#include "actuators/magnetics/radial_stator.h"

namespace ambrig {

RadialStator::RadialStator(const RadialStatorParameters& parameters) : p_(parameters) {
  Require(p_.winding.size() == kPoles, "a winding of eight letters N or S");
  for (int j = 0; j < kPoles; ++j) {
    const double gamma = (p_.first_pole_angle_deg + 360.0 / kPoles * j) * kPi / 180;
    cos_[j] = std::cos(gamma);
    sin_[j] = std::sin(gamma);
    s_[j] = p_.winding[static_cast<std::size_t>(j)] == 'N' ? 1 : -1;
  }
}

CoilVector RadialStator::Gap(const Eigen::Vector2d& r) const {
  return (p_.gap - r.x() * cos_.array() - r.y() * sin_.array()).matrix();
}

CoilVector RadialStator::Permeance(const Eigen::Vector2d& r) const {
  return (kMu0 * p_.pole_area / Gap(r).array()).matrix();
}

CoilVector RadialStator::Flux(const Eigen::Vector2d& r, const CoilVector& i) const {
  const CoilVector P = Permeance(r);
  const CoilVector mmf = p_.turns * s_.cwiseProduct(i);  // N s_j i_j
  const double U_r = P.dot(mmf) / P.sum();               // from Σ phi_j = 0
  return P.cwiseProduct((mmf.array() - U_r).matrix());
}

CoilMatrix RadialStator::Inductance(const Eigen::Vector2d& r) const {
  const CoilVector P = Permeance(r);
  const CoilVector SP = s_.cwiseProduct(P);
  CoilMatrix L = -SP * SP.transpose() / P.sum();
  L.diagonal() += P;  // S P S = P, because s_j² = 1
  L *= p_.turns * p_.turns;
  L.diagonal().array() += p_.leakage_inductance;
  return L;
}

Eigen::Vector2d RadialStator::Force(const Eigen::Vector2d& r, const CoilVector& i) const {
  const CoilVector pull = Flux(r, i).cwiseAbs2() / (2 * kMu0 * p_.pole_area);
  return {pull.dot(cos_), pull.dot(sin_)};
}

CoilVector RadialStator::Currents(const Eigen::Vector2d& r, const CoilVector& lambda) const {
  // Per pole phi (1/P + N²/L_l) = N s λ/L_l - U_r; Σ phi = 0 gives U_r.
  const double c = p_.turns / p_.leakage_inductance;
  const CoilVector G = (1.0 / (1.0 / Permeance(r).array() + p_.turns * c)).matrix();
  const CoilVector m = c * s_.cwiseProduct(lambda);
  const double U_r = G.dot(m) / G.sum();
  const CoilVector phi = G.cwiseProduct((m.array() - U_r).matrix());
  return (lambda - p_.turns * s_.cwiseProduct(phi)) / p_.leakage_inductance;
}

double RadialStator::ForceConstant() const {
  return 4 * kMu0 * p_.turns * p_.turns * p_.pole_area / (p_.gap * p_.gap);
}

}  // namespace ambrig
