#include "rotor/shaft/convert_shaft.h"

#include <fmt/format.h>

#include "core/math/constants.h"
#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/rotor_modes.h"
#include "rotor/shaft/shaft_file.h"

namespace ambrig {

ShaftConversion ConvertShaft(const std::string& in, const std::string& out) {
  ShaftConversion c;
  const BeamFile file = ReadShaft(in, &c.from_ross, &c.not_carried);
  if (c.from_ross && !out.ends_with(".toml"))
    throw InputError(fmt::format("{}: allowed: a .toml file (its [rotor] is ambrig's)", out));
  if (!c.from_ross && !out.ends_with(".toml") && !out.ends_with(".json"))
    throw InputError(fmt::format("{}: allowed: a .toml or .json file, as ROSS loads them", out));
  const BeamRotor beam = BuildBeam(file.definition);
  const RotorTotals totals = Totals(beam);
  c.mass = totals.mass;
  c.z_com = totals.z_com;
  for (const double w : FreeModes(beam, 4).omega) c.free_bending.push_back(w / (2 * kPi));
  if (c.from_ross)
    WriteBeam(file, out);
  else
    WriteRoss(file.definition, out);
  return c;
}

}  // namespace ambrig
