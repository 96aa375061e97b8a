#include "rotor/shaft/support_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/counted.h"
#include "rotor/shaft/shaft_tables.h"

namespace ambrig {

namespace {

constexpr Range kMassOnShaft{"kg", 0, 1e9, "mass"};

/// Coefficients over the speed: arrays as long as `speed`, or one number for all of it.
void ReadTable(const TomlTable& row, SpringSupport& s) {
  s.speed = AllWithin(row, "speed", {}, {"rad/s", 0, 1e6, "speed of the shaft"});
  if (s.speed.empty()) row.Fail("speed", "is empty, allowed: rising speeds [rad/s]");
  if (!std::is_sorted(s.speed.begin(), s.speed.end(), std::less_equal<>()))
    row.Fail("speed", "does not rise, allowed: rising speeds [rad/s]");
  s.cubic = row.Choice("interpolation", "linear", "linear, cubic") == "cubic";
  s.table.assign(s.speed.size(), s);
  for (const Field<SupportCoefficients>& f : kSupportCoefficients) {
    if (!row.IsArray(f.key)) continue;
    const std::vector<double> values = AllWithin(row, f.key, {}, {f.unit, f.lo, f.hi, f.doc});
    if (values.size() != s.speed.size())
      row.Fail(f.key, fmt::format("has {}, allowed: one, or as many as speed ({})",
                                  Counted(values.size(), "value"), s.speed.size()));
    for (std::size_t k = 0; k < values.size(); ++k) s.table[k].*f.at = values[k];
  }
}

/// `mass`, or mass_x, mass_y, mass_z, which are the first one unless given.
void ReadMasses(const TomlTable& row, double& x, double& y, double& z, bool positive) {
  const double all = Within(row, "mass", row.Has("mass_x") ? 0.0 : kRequired, kMassOnShaft);
  x = Within(row, "mass_x", all, kMassOnShaft);
  y = Within(row, "mass_y", x, kMassOnShaft);
  z = Within(row, "mass_z", x, kMassOnShaft);
  for (const char* key : {"mass", "mass_x", "mass_y", "mass_z"}) RejectSd(row, {key}, nullptr);
  if (positive && !(x > 0 && y > 0))
    row.Fail(row.Has("mass_x") ? "mass_x" : "mass",
             "= 0 kg, allowed: above 0 (a housing without mass has no equation of motion)");
}

}  // namespace

SpringSupport ReadSupport(const TomlTable& row, std::vector<Tolerance>* tolerances) {
  const bool table = row.Has("speed");
  SpringSupport s;
  s.name = row.String("name", "");
  s.carries = row.String("carries", "");
  s.on = row.String("on", "");
  if (row.Has("to") && !s.on.empty()) row.Fail("to", "is given beside on, allowed: one of them");
  if (row.Has("to_z") && !row.Has("to"))
    row.Fail("to_z", "is given without to, allowed: with to, the shaft on which it stands");
  if (s.on_shaft())
    s.z = Within(row, "z", kRequired, kPlaceOnShaft);
  else if (row.Has("z"))
    row.Fail("z", "is given beside carries, allowed: one of them");
  if (row.Has("to")) s.to_z = Within(row, "to_z", s.z, kPlaceOnShaft);
  RejectSd(row, {"z", "to_z"}, tolerances);
  for (const char* key : {"k", "c"}) {
    if (!row.Has(key)) continue;
    const bool k = *key == 'k';
    Range range =
        k ? Range{"N/m", -1e21, 1e21, "stiffness"} : Range{"N s/m", -1e12, 1e12, "damping"};
    (k ? s.kxx : s.cxx) = Within(row, key, 0.0, range);
    (k ? s.kyy : s.cyy) = k ? s.kxx : s.cxx;
    double sd = 0;
    row.Number(key, 0.0, &sd);
    if (tolerances && sd > 0) tolerances->push_back({row.path() + "." + key, sd, kRequired});
  }
  for (const Field<SupportCoefficients>& f : kSupportCoefficients) {
    if (!row.Has(f.key) || (table && row.IsArray(f.key))) continue;
    const Field<SupportCoefficients> one[] = {f};
    SupportCoefficients& c = s;
    row.Read(c, one, tolerances);
  }
  if (table) ReadTable(row, s);
  row.RejectUnknownKeys();
  return s;
}

Housing ReadHousing(const TomlTable& row) {
  Housing h;
  h.name = row.String("name");
  if (h.name.empty()) row.Fail("name", "is empty, allowed: a name");
  ReadMasses(row, h.mass_x, h.mass_y, h.mass_z, true);
  row.RejectUnknownKeys();
  return h;
}

PointMass ReadPointMass(const TomlTable& row) {
  PointMass m;
  m.name = row.String("name", "");
  m.z = Within(row, "z", kRequired, kPlaceOnShaft);
  ReadMasses(row, m.mass_x, m.mass_y, m.mass_z, false);
  row.RejectUnknownKeys();
  return m;
}

void CheckHousings(const TomlTable& rotor, const BeamDefinition& d) {
  std::string names;
  for (std::size_t k = 0; k < d.housings.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j)
      if (d.housings[j].name == d.housings[k].name)
        rotor.Fail("housing", fmt::format("\"{}\" stands twice, allowed: names of their own",
                                          d.housings[k].name));
    names += (names.empty() ? "" : ", ") + d.housings[k].name;
  }
  for (const SpringSupport& s : d.supports)
    for (const auto& [key, name] : {std::pair{"carries", s.carries}, std::pair{"on", s.on}}) {
      const auto same = [&name = name](const Housing& h) { return h.name == name; };
      if (name.empty() || std::any_of(d.housings.begin(), d.housings.end(), same)) continue;
      rotor.Fail("support", fmt::format("{} = \"{}\", allowed: a [[rotor.housing]]{}", key, name,
                                        names.empty() ? "" : " (" + names + ")"));
    }
  for (const SpringSupport& s : d.supports)
    if (!s.on.empty() && s.on == s.carries)
      rotor.Fail("support",
                 fmt::format("on = \"{}\" is what it carries, allowed: another housing", s.on));
}

}  // namespace ambrig
