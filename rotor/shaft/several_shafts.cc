#include "rotor/shaft/several_shafts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "rotor/shaft/beam.h"

namespace ambrig {

namespace {

/// Left and right end of a shaft's own sections.
std::pair<double, double> EndsOf(const BeamDefinition& d, const std::string& shaft) {
  double lo = kInfinity, hi = -kInfinity;
  for (const ShaftSection& s : d.sections)
    if (s.shaft == shaft && s.stiff) {
      lo = std::min(lo, s.z0);
      hi = std::max(hi, s.z0 + s.length);
    }
  if (!(hi > lo))
    throw InputError(fmt::format("shaft \"{}\" has no section, allowed: at least one", shaft));
  return {lo, hi};
}

}  // namespace

const PlacedShaft* ShaftAt(const std::vector<PlacedShaft>& shafts, double z) {
  const PlacedShaft* found = shafts.empty() ? nullptr : &shafts.front();
  for (const PlacedShaft& s : shafts)
    if (s.start <= z + 1e-6 * std::abs(s.start)) found = &s;
  return found;
}

double PlaceOf(const std::vector<PlacedShaft>& shafts, double z) {
  const PlacedShaft* s = ShaftAt(shafts, z);
  return s ? z - s->shift() : z;
}

std::string PlaceText(const std::vector<PlacedShaft>& shafts, double z) {
  const PlacedShaft* s = ShaftAt(shafts, z);
  return s ? fmt::format("z = {:g} m of {}", z - s->shift(), s->name)
           : fmt::format("z = {:g} m", z);
}

double NodePlace(const std::vector<PlacedShaft>& shafts, const std::string& shaft, double z) {
  for (const PlacedShaft& s : shafts)
    if (s.name == shaft) return z + s.shift();
  return z;
}

void LayOutShafts(BeamDefinition& d) {
  double next = 0;
  for (PlacedShaft& s : d.shafts) {
    const auto [lo, hi] = EndsOf(d, s.name);
    s.z = lo;
    s.start = &s == &d.shafts.front() ? lo : next;
    next = hi + s.shift() + 0.25 * (hi - lo);
  }
  const auto move = [&](double& z, const std::string& shaft) { z = NodePlace(d.shafts, shaft, z); };
  for (ShaftSection& s : d.sections) move(s.z0, s.shaft);
  for (Disk& disk : d.disks) move(disk.z, disk.shaft);
  for (PointMass& m : d.masses) move(m.z, m.shaft);
  for (SpringSupport& s : d.supports) {
    move(s.z, s.shaft);
    move(s.to_z, s.to);
  }
}

}  // namespace ambrig
