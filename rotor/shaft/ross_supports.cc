#include "rotor/shaft/ross_supports.h"

#include <algorithm>

#include "core/base/counted.h"
#include "rotor/shaft/ross_magnets.h"
#include "rotor/shaft/ross_nodes.h"

namespace ambrig {

namespace {

/// One coefficient over the speeds of the table, or one value.
std::vector<double> RossCoefficient(const RossElement& e, const std::string& key,
                                    std::vector<double> fallback) {
  return e.Has(key) ? e.numbers.at(key) : fallback;
}

/// `omega` of BearingFluidFlow, whose other numbers describe how it was computed.
const char* SpeedAxis(const RossElement& e) {
  for (const char* key : {"speed", "frequency", "omega"})
    if (e.Has(key)) return key;
  return "w";
}

std::vector<double> CoefficientOf(const RossElement& e, const std::string& key) {
  // kyy, cyy and myy are the x ones unless given.
  const bool second = key.substr(1) == "yy";
  return RossCoefficient(
      e, key,
      second ? RossCoefficient(e, key.substr(0, 1) + "xx", {0.0}) : std::vector<double>{0.0});
}

void ReadRossCoefficients(const RossElement& e, SpringSupport& s, std::vector<std::string>& lost) {
  const std::string axis = SpeedAxis(e);
  for (const Field<SupportCoefficients>& f : kSupportCoefficients) {
    const std::vector<double> y = CoefficientOf(e, std::string(f.key));
    const bool constant = std::all_of(y.begin(), y.end(), [&](double v) { return v == y[0]; });
    s.*f.at = y[0];
    if (y.size() == 1) continue;
    if (!e.Has(axis) || e.numbers.at(axis).size() != y.size())
      e.Fail(fmt::format("{} has {}, allowed: one, or as many as {}", f.key,
                         Counted(y.size(), "value"), axis));
    if (constant) continue;
    s.speed = e.numbers.at(axis);
  }
  if (!s.varies()) return;
  if (!std::is_sorted(s.speed.begin(), s.speed.end(), std::less_equal<>()))
    e.Fail(fmt::format("{} does not rise, allowed: rising speeds [rad/s]", axis));
  s.cubic = s.speed.size() > 2;
  if (const auto kind = e.texts.find("interpolation");
      kind != e.texts.end() && kind->second == "linear")
    s.cubic = false;
  else if (kind != e.texts.end() && kind->second == "pchip")
    lost.push_back(fmt::format("interpolation pchip of {}, taken as cubic splines", e.Label()));
  s.table.assign(s.speed.size(), s);
  for (const Field<SupportCoefficients>& f : kSupportCoefficients) {
    const std::vector<double> y = CoefficientOf(e, std::string(f.key));
    for (std::size_t k = 0; k < y.size() && y.size() > 1; ++k) s.table[k].*f.at = y[k];
  }
}

bool IsRossSupport(const RossElement& e) {
  return e.Has("kxx") && !e.two_axes && !IsRossMagneticBearing(e);
}

/// The names of housings by node: every node off the shaft that a bearing reaches.
std::map<int, std::string> HousingNodes(const std::vector<RossElement>& elements,
                                        const RossNodes& nodes) {
  std::map<int, std::string> out;
  const auto add = [&](int n) {
    if (!nodes.on_shaft(n)) out.emplace(n, fmt::format("node_{}", n));
  };
  for (const RossElement& e : elements) {
    if (!IsRossSupport(e)) continue;
    add(e.Node());
    if (e.Has("n_link")) add(static_cast<int>(e.Get("n_link")));
  }
  return out;
}

void ReadRossMasses(const RossElement& e, double* mass) {
  const bool own = e.Has("mx") || e.Has("my");
  mass[0] = own ? e.Get("mx", 0) : e.Get("m");
  mass[1] = own ? e.Get("my", 0) : mass[0];
  mass[2] = e.Get("mz", own ? 0 : mass[0]);
  for (int k = 0; k < 3; ++k)
    if (!(mass[k] >= 0 && mass[k] <= 1e9)) e.Fail("a mass is not within 0 to 1e9 kg");
}

void AddRossSupport(const RossElement& e, const std::map<int, std::string>& housings,
                    const RossNodes& nodes, BeamDefinition& d, std::vector<std::string>& lost) {
  SpringSupport s;
  s.name = e.name;
  const auto sits = housings.find(e.Node());
  if (sits != housings.end())
    s.carries = sits->second;
  else
    s.z = nodes.At(e);
  s.shaft = nodes.ShaftOf(e.Node());
  if (e.Has("n_link")) {
    const int link = static_cast<int>(e.Get("n_link"));
    const auto on = housings.find(link);
    if (on != housings.end()) {
      s.on = on->second;
    } else {
      if (nodes.ShaftOf(link).empty() || nodes.ShaftOf(link) == s.shaft)
        e.Fail(
            fmt::format("n_link = {} is a node of the same shaft, allowed: a node of another "
                        "shaft, or one with a point mass off all of them",
                        link));
      s.to_z = nodes.At(e, link);
      s.to = nodes.ShaftOf(link);
    }
  }
  ReadRossCoefficients(e, s, lost);
  d.supports.push_back(std::move(s));
}

}  // namespace

void AddRossSupports(const std::vector<RossElement>& elements, const RossNodes& nodes,
                     BeamDefinition& d, std::vector<std::string>& lost) {
  const std::map<int, std::string> housings = HousingNodes(elements, nodes);
  std::map<int, Housing> found;
  for (const RossElement& e : elements) {
    if (IsRossSupport(e)) AddRossSupport(e, housings, nodes, d, lost);
    if (e.kind.find("PointMass") != 0) continue;
    double mass[3];
    ReadRossMasses(e, mass);
    const int n = e.Node();
    if (nodes.on_shaft(n)) {
      d.masses.push_back({nodes.At(e), mass[0], mass[1], mass[2], e.name, nodes.ShaftOf(n)});
    } else if (housings.count(n)) {
      Housing& h = found.try_emplace(n, Housing{housings.at(n), 0, 0, 0}).first->second;
      h.mass_x += mass[0];
      h.mass_y += mass[1];
      h.mass_z += mass[2];
    } else {
      lost.push_back(
          fmt::format("{}: {} kg at a node that no bearing reaches", e.Label(), mass[0]));
    }
  }
  for (const auto& [n, name] : housings) {
    const auto h = found.find(n);
    if (h == found.end() || !(h->second.mass_x > 0 && h->second.mass_y > 0)) {
      for (const RossElement& e : elements)
        if (IsRossSupport(e) && (e.Node() == n || e.Get("n_link", -1) == n))
          e.Fail(
              fmt::format("n or n_link = {} is off the shaft and has no PointMass, allowed: a mass "
                          "above 0 there",
                          n));
    }
    d.housings.push_back(h->second);
  }
}

}  // namespace ambrig
