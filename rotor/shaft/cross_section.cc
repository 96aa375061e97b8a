#include "rotor/shaft/cross_section.h"

#include "core/math/constants.h"

namespace ambrig {

CrossSection SectionAt(const ShaftElement& e, const BeamTheory& theory, double s) {
  CrossSection out;
  for (const ShaftSection& l : e.layers) {
    const double t = s / e.length;
    const double od = l.od + t * (l.od_right - l.od), id = l.id + t * (l.id_right - l.id);
    const double A = kPi / 4 * (od * od - id * id);
    const double I = kPi / 64 * (std::pow(od, 4) - std::pow(id, 4));
    out.rhoA += l.material.rho * A;
    out.rhoI += l.material.rho * I;
    if (!l.stiff) continue;
    out.EI += l.material.E * I;
    // The bore ratio of the element's middle, so that kappa is one number per element and layer.
    const double kappa = ShearCoefficientOf(
        theory.coefficient, (l.id + l.id_right) / (l.od + l.od_right), l.material.nu);
    out.kGA += kappa * l.material.shear_modulus() * A;
  }
  return out;
}

}  // namespace ambrig
