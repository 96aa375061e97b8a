#include "control/kinds/read_system.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace ambrig {

StateSpace SampledSystem(const TomlTable& t, const StateSpace& s, double rate,
                         const char* fallback) {
  if (t.Choice("domain", fallback, "s, z") == "z") return s;
  const StateSpace z = Bilinear(s, 1 / rate);
  if (!z.A.allFinite())
    t.Fail("domain", fmt::format("= \"s\": a pole at 2 rate = {} 1/s cannot be sampled", 2 * rate));
  return z;
}

void CheckAscending(const TomlTable& t, double before, double speed) {
  if (speed <= before)
    t.Fail("speed",
           fmt::format("= {} rad/s after {} rad/s, allowed: ascending speeds", speed, before));
}

namespace {
void ReadSpeeds(const TomlTable& t, ControllerParameters& c) {
  c.speeds = t.Numbers("speeds", {0.0});
  for (std::size_t k = 0; k < c.speeds.size(); ++k)
    if (!(c.speeds[k] >= 0 && c.speeds[k] <= 1e5) || (k > 0 && c.speeds[k] <= c.speeds[k - 1]))
      t.Fail("speeds", fmt::format("= {} rad/s, allowed: ascending, 0 to 1e5", c.speeds[k]));
  if (c.speeds.empty() || c.speeds.size() > 50) t.Fail("speeds", "allowed: 1 to 50 speeds");
}

}  // namespace

void ReadSynthesis(const TomlTable& t, const ControllerNames& names, ControllerParameters& c) {
  ReadSpeeds(t, c);
  std::set<std::string> named;  // of planes
  for (const TomlTable& k : t.Tables("plane")) {
    PlaneWeight w;
    w.at = k.String("at");
    if (std::find(names.planes.begin(), names.planes.end(), w.at) == names.planes.end())
      k.Fail("at", fmt::format("= \"{}\", allowed: {}", w.at, fmt::join(names.planes, ", ")));
    if (!named.insert(w.at).second)
      k.Fail("at", fmt::format("= \"{}\" stands twice, allowed: once", w.at));
    k.Read(w, kPlaneWeightFields);
    k.RejectUnknownKeys();
    c.planes.push_back(w);
  }
  if (const auto m = t.Table("modes")) {
    c.modes.emplace();
    m->Read(*c.modes, kModeWeightFields);
    m->RejectUnknownKeys();
  }
  if (!t.Has("model_modes")) return;
  const long long modes = t.Integer("model_modes", 0);
  if (modes < 0 || modes > 100)
    t.Fail("model_modes", fmt::format("= {}, allowed: 0 to 100", modes));
  c.model_modes = static_cast<int>(modes);
}

}  // namespace ambrig
