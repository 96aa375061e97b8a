#include "analysis/shaft/shaft_planes.h"

#include <fmt/format.h>

#include <algorithm>

namespace ambrig {

namespace {

std::string NameOfSupport(const SpringSupport& s) {
  return s.name.empty() ? fmt::format("z = {:g}", s.z) : s.name;
}

}  // namespace

std::vector<ShaftProbe> NamedPlanes(const BeamFile& file, const BeamRotor& beam) {
  std::vector<ShaftProbe> out;
  const auto add = [&](const std::string& name, double z) {
    for (const ShaftProbe& p : out)
      if (p.housing.empty() && std::abs(p.z - z) < 1e-9) return;
    out.push_back({name, z, ""});
  };
  for (const SpringSupport& s : file.definition.supports)
    if (s.on_shaft()) add(NameOfSupport(s), s.z);
  for (const ShaftPlane& p : file.planes) add(p.name, p.z);
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  if (out.empty()) {
    add("left end", beam.z.front());
    add("right end", beam.z.back());
  }
  for (const Housing& h : file.definition.housings) out.push_back({h.name, 0, h.name});
  return out;
}

ShaftProbe FindPlane(const BeamFile& file, const PlaneChoice& choice, const char* option) {
  std::string names;
  const auto is = [&](const std::string& name) {
    if (!name.empty()) names += (names.empty() ? "" : ", ") + name;
    return !name.empty() && name == choice.text;
  };
  for (const ShaftPlane& p : file.planes)
    if (is(p.name)) return {p.name, p.z, ""};
  for (const SpringSupport& s : file.definition.supports)
    if (s.on_shaft() && is(s.name)) return {s.name, s.z, ""};
  for (const Housing& h : file.definition.housings)
    if (is(h.name)) return {h.name, 0, h.name};
  // "0.3", or "outer/0.3" of several shafts
  const std::vector<PlacedShaft>& shafts = file.definition.shafts;
  std::string shaft = shafts.empty() ? "" : shafts.front().name, place = choice.text;
  if (const std::size_t slash = place.find('/'); !shafts.empty() && slash != std::string::npos) {
    shaft = place.substr(0, slash);
    place = place.substr(slash + 1);
  }
  double lo = kInfinity, hi = -kInfinity;
  for (const ShaftSection& s : file.definition.sections) {
    if (!s.stiff || s.shaft != shaft) continue;
    lo = std::min(lo, s.z0);
    hi = std::max(hi, s.z0 + s.length);
  }
  std::size_t used = 0;
  double z = kRequired;
  try {
    z = NodePlace(shafts, shaft, std::stod(place, &used));
  } catch (const std::exception&) {
    used = std::string::npos;
  }
  const double rounding = 1e-9 * (hi - lo);
  if (used == place.size() && z >= lo - rounding && z <= hi + rounding)
    return {shafts.empty() ? fmt::format("z = {:g}", z) : choice.text, z, ""};
  for (const PlacedShaft& s : shafts) names += ", " + s.name + "/z";
  if (lo > hi) lo = hi = 0;
  lo = PlaceOf(shafts, lo);
  hi = PlaceOf(shafts, hi);
  throw InputError(fmt::format("--{}: plane {}, allowed: a z from {:g} to {:g} m{}{}", option,
                               choice.text, lo, hi, names.empty() ? "" : " or ", names));
}

}  // namespace ambrig
