/// How fast a contact of the rotor changes, which decides how fine a step must be. Apart from
/// rotor_motion.cc, because it is needed near a contact only.
#include <algorithm>
#include <cmath>

#include "core/base/index.h"

#include "rotor/motion/rotor_model.h"

namespace ambrig {

double RotorModel::StiffnessRate(const MotionState& s) const {
  // Fastest rate [1/s] among the contacts: impact, regularised friction on journal and race,
  // mounts.
  double rate = 0;
  for (std::size_t k = 0; k < aux_.size(); ++k) {
    const AuxiliaryPlane& aux = aux_[k];
    const AuxiliaryParameters& p = aux.parameters;
    const double depth = std::max(Penetration(s, k), 0.0);
    const double reach = std::max(depth, 1e-6);
    const double stiffness = p.exponent * p.stiffness * std::pow(reach, p.exponent - 1);
    const double arm = aux.map.z;
    double mobility = 1 / p_.mass + arm * arm / p_.inertia_transverse;
    for (int c = 4; c < aux.map.count; ++c)
      mobility += aux.map.wx[AsSize(c)] * aux.map.wx[AsSize(c)];
    if (aux.mount_dof >= 0) {
      mobility += 1 / p.mount_mass;
      rate = std::max(
          {rate, std::sqrt(p.mount_stiffness / p.mount_mass), p.mount_damping / p.mount_mass});
    }
    rate = std::max(rate, std::sqrt(stiffness * mobility));
    const double normal = p.stiffness * std::pow(depth, p.exponent);
    double tangential =
        mobility + p_.journal_radius * p_.journal_radius / std::max(p_.inertia_polar, 1e-9);
    if (aux.race_dof >= 0) tangential += p_.journal_radius * p_.journal_radius / p.race_inertia;
    rate = std::max(
        {rate, p.friction * normal / kSlidingSpeed * tangential, p.damping * normal * mobility});
  }
  if (has_axial_ && axial_free) rate = std::max(rate, std::sqrt(axial_.stiffness / p_.mass));
  return rate;
}

}  // namespace ambrig
