#include "scenarios/start_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

void CheckResting(const TomlTable& start, const RigParameters& rig) {
  const auto catches = std::ranges::count_if(rig.bearings, [](const BearingParameters& b) {
    return b.kind->two_axes && b.auxiliary.has_value();
  });
  if (catches < 2)
    start.Fail("state", fmt::format("= \"resting\" with {} radial auxiliary bearings, allowed: two",
                                    catches));
  if (rig.gravity[0] == 0 && rig.gravity[1] == 0)
    start.Fail("state",
               "= \"resting\" without gravity across the shaft, allowed: gravity = [x, y, z] of "
               "the rig with x or y other than 0");
}

void ReadPosition(const TomlTable& position, const std::string& key, const RigParameters& rig,
                  Scenario& s) {
  const BearingParameters* b = rig.Find(key);
  if (!b) {
    std::string names;
    for (const BearingParameters& each : rig.bearings)
      names += (names.empty() ? "" : ", ") + each.name;
    position.Fail(key, "is no bearing, allowed: " + names);
  }
  std::vector<double> xy = position.IsNumber(key) ? std::vector<double>{position.Number(key), 0.0}
                                                  : position.Numbers(key);
  if (xy.size() == 1) xy.push_back(0);
  if (xy.size() != 2) position.Fail(key, "allowed: [x, y] in m");
  if (!std::isfinite(xy[0]) || !std::isfinite(xy[1]) || InPole(*b, xy[0], xy[1]))
    position.Fail(
        key, fmt::format("= [{}, {}] m, allowed: inside the gap of {} m", xy[0], xy[1], GapOf(*b)));
  s.clamp[key] = {xy[0], xy[1]};
}

/// A coil that flows `current` at t = 0 whatever is commanded then.
void ReadStartCurrent(const TomlTable& currents, const std::string& key, const RigParameters& rig,
                      Scenario& s) {
  const std::vector<std::string> coils = TargetsOfEffects(rig).coils;
  if (std::ranges::find(coils, key) == coils.end())
    currents.Fail(key,
                  "is no coil, allowed: those of the rig, \"" + coils.front() + "\" for example");
  const double i = currents.Number(key), most = rig.amplifier.adc_range,
               least = rig.amplifier.quadrants < 3 ? 0 : -most;
  if (i < least || i > most)
    currents.Fail(key, fmt::format("= {} A, allowed: {} to {} A", i, least, most));
  s.start_current[key] = i;
}

}  // namespace

void ReadStart(const TomlTable& root, const RigParameters& rig, Scenario& s) {
  const auto t = root.Table("start");
  if (!t) return;
  const std::string state = t->Choice("state", "levitated", "levitated, resting, clamped");
  s.start = state == "levitated" ? StartState::kLevitated
            : state == "resting" ? StartState::kResting
                                 : StartState::kClamped;
  if (s.start == StartState::kResting) CheckResting(*t, rig);
  const auto of_clamped = [&](const char* key, const auto& read) {
    const auto values = t->Table(key);
    if (!values) return;
    if (s.start != StartState::kClamped) t->Fail(key, "is only allowed with state = \"clamped\"");
    for (const auto& name : values->Keys()) read(*values, name, rig, s);
  };
  of_clamped("position", ReadPosition);
  of_clamped("current", ReadStartCurrent);
  t->RejectUnknownKeys();
}

}  // namespace ambrig
