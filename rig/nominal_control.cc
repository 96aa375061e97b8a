#include "rig/nominal_control.h"

#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

BearingControl MakeBearingControl(const NominalRig& nominal, std::size_t k) {
  const BearingParameters& p = nominal->bearings[k];
  BearingControl c;
  c.name = p.name;
  c.coils = p.coils();
  c.regulator = CurrentRegulators(nominal->amplifier);
  c.map.k = ForceConstant(p);
  c.map.c0 = BiasCurrent(*nominal, p);
  c.map.i_max = nominal->amplifier.i_max;
  c.map.unipolar = nominal->amplifier.quadrants < 3;
  if (p.kind->linearise) {
    const BiasLinearisation at = p.kind->linearise(p, nominal->controller.bias_current);
    c.map.k = at.k;
    c.map.c0 = at.c0;
    c.map.W.topRows(at.W.rows()) = at.W;
    return c;
  }
  const auto directions = CoilDirections(p);
  for (std::size_t j = 0; j < directions.size(); ++j)
    c.map.W.row(static_cast<Eigen::Index>(j)) << 1, directions[j][0], directions[j][1];
  return c;
}

}  // namespace ambrig
