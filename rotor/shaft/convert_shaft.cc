#include "rotor/shaft/convert_shaft.h"

#include <fmt/format.h>

#include "core/base/atomic_file.h"
#include "core/math/constants.h"
#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/rotor_modes.h"
#include "rotor/shaft/shaft_file.h"

namespace ambrig {

ShaftConversion ConvertShaft(const std::string& in, const std::string& out) {
  ShaftConversion c;
  std::vector<RossMagnet> magnets;
  BeamFile file = ReadShaft(in, &c.from_ross, &c.not_carried, nullptr, &magnets);
  if (c.from_ross && !out.ends_with(".toml"))
    throw InputError(fmt::format("{}: allowed: a .toml file (its [rotor] is ambrig's)", out));
  if (!c.from_ross && !out.ends_with(".toml") && !out.ends_with(".json"))
    throw InputError(fmt::format("{}: allowed: a .toml or .json file, as ROSS loads them", out));
  const BeamRotor beam = BuildBeam(file.definition);
  const RotorTotals totals = Totals(beam);
  c.mass = totals.mass;
  c.z_com = totals.z_com;
  for (const double w : FreeModes(beam, 4).omega) c.free_bending.push_back(w / (2 * kPi));
  const std::string not_rig = NoRigShaft(file.definition);
  c.magnetic_bearings = not_rig.empty() ? magnets.size() : 0;
  if (c.magnetic_bearings > 0) {
    for (const RossMagnet& m : magnets)  // the bearings carry the names
      std::erase_if(file.planes, [&](const ShaftPlane& p) { return p.name == m.name; });
    WriteFileAtomically(out, MagneticRigText(file, magnets));
  } else if (c.from_ross) {
    for (const RossMagnet& m : magnets)
      c.not_carried.push_back(fmt::format(
          "{}: a magnetic bearing beside {}, which no rig takes; its plane kept as a station: g0 "
          "= {:g}, i0 = {:g}, ag = {:g}, nw = {:g}",
          m.name, not_rig, m.gap, m.bias, m.area, m.turns));
    WriteBeam(file, out);
  } else {
    const std::vector<RossMagnet> own = MagnetsOfRig(in, c.not_carried);
    c.magnetic_bearings = own.size();
    for (const std::string& l : WriteRoss(file.definition, out, own)) c.not_carried.push_back(l);
  }
  for (const double zeta : file.modal_damping)
    if (!c.from_ross && zeta != 0) {
      c.not_carried.push_back(fmt::format("modal_damping {:g} of the modes of a run", zeta));
      break;
    }
  return c;
}

}  // namespace ambrig
