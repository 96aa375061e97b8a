#include "scenarios/load_file.h"

#include <fmt/format.h>

#include "core/base/toml_checked.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_checks.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr Range kLoadTime{"s", -1e5, 1e5, "scenario time"};
constexpr Range kForce{"N", -1e8, 1e8, "force of a load"};

std::string LoadPlanes(const RigParameters& rig) {
  std::string names;
  for (const auto& b : rig.bearings) names += (names.empty() ? "" : ", ") + b.name;
  for (const auto& s : rig.stations) names += (names.empty() ? "" : ", ") + s.name;
  return names;
}

void ReadPlace(const TomlTable& t, const RigParameters& rig, LoadSpec& l) {
  if (t.Has("plane") == t.Has("z")) t.Fail("plane", "allowed: either plane = \"A\" or z = m");
  if (t.Has("plane")) {
    const std::string plane = t.String("plane");
    const BearingParameters* b = rig.Find(plane);
    const ShaftPlane* station = rig.FindStation(plane);
    if (!b && !station)
      t.Fail("plane", fmt::format("= \"{}\", allowed: {}", plane, LoadPlanes(rig)));
    l.z = b ? b->z : station->z;
    l.axial = b && b->kind->axial;
    return;
  }
  const auto [lo, hi] = ShaftExtent(rig);
  l.z = Within(t, "z", kRequired,
               {"m", lo + rig.z_origin, hi + rig.z_origin, "a place on the shaft"}) -
        rig.z_origin;
}

/// Few numbers mean what acts at the plane: along the shaft one, across it two.
void ReadForce(const TomlTable& t, LoadSpec& l) {
  const auto f = t.IsNumber("force")
                     ? std::vector<double>{Within(t, "force", kRequired, kForce)}
                     : (t.Has("force") ? AllWithin(t, "force", {}, kForce) : t.Numbers("force"));
  const std::size_t few = l.axial ? 1 : 2;
  if (f.size() != few && f.size() != 3)
    t.Fail("force", l.axial ? "at a bearing along the shaft, allowed: fz or [fx, fy, fz] in N"
                            : "allowed: [fx, fy] or [fx, fy, fz] in N");
  if (f.size() > 1) {
    l.fx = f[0];
    l.fy = f[1];
  }
  if (f.size() != 2) l.fz = f.back();
}

}  // namespace

void ReadLoads(const TomlTable& root, const RigParameters& rig, Scenario& s) {
  for (const TomlTable& t : root.Tables("load")) {
    LoadSpec l;
    ReadPlace(t, rig, l);
    ReadForce(t, l);
    l.start = Within(t, "start", 0, kLoadTime);
    l.stop = Within(t, "stop", s.duration, kLoadTime);
    if (!(l.stop > l.start))
      t.Fail("stop", fmt::format("= {} s, allowed: later than start = {} s", l.stop, l.start));
    t.RejectUnknownKeys();
    s.loads.push_back(l);
  }
}

}  // namespace ambrig
