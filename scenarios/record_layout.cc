#include "scenarios/record_layout.h"

#include <fmt/format.h>

namespace ambrig {

std::vector<std::size_t> AddRecordChannels(Recorder& recorder, const RigParameters& rig,
                                           bool clamped, std::size_t rows) {
  std::vector<std::size_t> channels;
  const auto add = [&](const std::string& name, const char* unit) {
    channels.push_back(recorder.Add(name, unit, rows));
  };
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& axis : b.Axes()) add(axis, "m");
  for (const BearingParameters& b : rig.bearings) {
    for (int j = 1; j <= b.coils(); ++j) add(fmt::format("{}.i{}", b.name, j), "A");
    for (int j = 1; j <= b.coils(); ++j) add(fmt::format("{}.s{}", b.name, j), "A");
    for (int j = 1; j <= b.coils(); ++j) add(fmt::format("{}.d{}", b.name, j), "-");
    if (clamped) {
      add(b.kind == BearingKind::kThrust ? b.name + ".fz" : b.name + ".fx", "N");
      if (b.kind == BearingKind::kRadial) add(b.name + ".fy", "N");
    } else {
      add(b.kind == BearingKind::kThrust ? "r.z" : b.name + ".r.x", "m");
      if (b.kind == BearingKind::kRadial) add(b.name + ".r.y", "m");
    }
  }
  for (const ShaftPlane& s : rig.stations) {  // true positions of a beam rotor's named planes
    if (clamped) break;
    add(s.name + ".r.x", "m");
    add(s.name + ".r.y", "m");
  }
  add("omega", "rad/s");
  add("theta", "rad");
  add("bus", "V");
  return channels;
}

}  // namespace ambrig
