#pragma once
/// Which channels of the table (core/record/channels.h) a rig has.
#include <vector>

#include "core/record/channels.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Of one bearing, in the order of its axes or coils; none for a kind that belongs to the rig.
std::vector<ChannelId> ChannelsOf(const BearingParameters& bearing, ChannelKind kind);

/// True positions of a station of the shaft.
std::vector<ChannelId> ChannelsOf(const ShaftPlane& station);

/// Of all bearings in their order, then of the stations (true positions only); or the rig's one.
std::vector<ChannelId> ChannelsOf(const RigParameters& rig, ChannelKind kind);

}  // namespace ambrig
