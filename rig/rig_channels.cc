#include "rig/rig_channels.h"

#include "core/base/errors.h"

namespace ambrig {

namespace {

constexpr int kAxialDirection = 2;

/// Directions that a bearing acts in, from the names of its axes: its readings are called as they.
std::vector<int> DirectionsOf(const BearingParameters& b) {
  std::vector<int> out;
  for (const std::string& axis : b.Axes()) {
    const auto id = ParseChannel(axis);
    Require(id && id->kind == ChannelKind::kReading, "an axis is called as its reading");
    out.push_back(id->index);
  }
  return out;
}

/// The name along the shaft does not tell the bearing, for there is one thrust bearing.
ChannelId DirectionChannel(const BearingParameters& b, const ChannelRow& row, int direction) {
  const bool by_plane = direction != kAxialDirection || row.axial.empty();
  return {row.kind, by_plane ? b.name : "", direction};
}

}  // namespace

std::vector<ChannelId> ChannelsOf(const BearingParameters& bearing, ChannelKind kind) {
  const ChannelRow& row = RowOf(kind);
  std::vector<ChannelId> out;
  if (row.scope == ChannelScope::kDirection)
    for (const int direction : DirectionsOf(bearing))
      out.push_back(DirectionChannel(bearing, row, direction));
  if (row.scope == ChannelScope::kCoil)
    for (int j = 0; j < bearing.coils(); ++j) out.push_back({kind, bearing.name, j});
  return out;
}

std::vector<ChannelId> ChannelsOf(const ShaftPlane& station) {
  return {{ChannelKind::kTruePosition, station.name, 0},
          {ChannelKind::kTruePosition, station.name, 1}};
}

std::vector<ChannelId> ChannelsOf(const RigParameters& rig, ChannelKind kind) {
  if (RowOf(kind).scope == ChannelScope::kRig) return {{kind, "", 0}};
  std::vector<ChannelId> out;
  for (const BearingParameters& b : rig.bearings)
    for (ChannelId& id : ChannelsOf(b, kind)) out.push_back(std::move(id));
  if (kind == ChannelKind::kTruePosition)
    for (const ShaftPlane& s : rig.stations)
      for (ChannelId& id : ChannelsOf(s)) out.push_back(std::move(id));
  return out;
}

}  // namespace ambrig
