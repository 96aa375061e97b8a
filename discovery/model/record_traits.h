#pragma once
/// What a record over time holds for a model: which of its channels the engine predicts, whether
/// its rotor touches something, which effects can show in it.
#include <cstdint>
#include <string>
#include <vector>

#include "core/record/channels.h"
#include "discovery/case/case.h"

namespace ambrig {

/// [s] after which the loops of a record have forgotten how it started, or what went before a gap.
inline constexpr double kLoopsSettle = 0.004;

/// Whether the engine predicts this channel: not what the scenario or the clamp prescribes.
bool IsPredicted(const CaseRecord& record, const std::string& channel);

/// Whether a row at time t [s] of a record can be compared. With imposed motion what the coils
/// carried before the first row is not known where a controller fed them: the first 4 ms are left
/// out. With imposed currents the rotor's first velocity is not known: its observer has forgotten
/// it after one period of its frequency.
bool HasSettled(const CaseRecord& record, double t);

/// What drives a record with imposed currents: these and the positions, without gaps. What drives a
/// record with imposed motion: its positions (and set-points, where they were measured) without
/// gaps; axes that were not measured stand where the scenario holds them. Currents and duties that
/// the scenario itself commands to a clamped rig are taken from there: a record's row tells their
/// edges late.
Record DrivingRecord(const RigParameters& rig, const CaseRecord& record);

/// The same positions and currents measured once more: with the noise of `rig` and a seed.
Record WithReadingNoise(Record driving, const RigParameters& rig, std::uint64_t seed);

/// Channels of a bearing in their order; empty unless the record has them all.
std::vector<const Channel*> ChannelsIn(const Record& record, const BearingParameters& b,
                                       ChannelKind kind);

/// Whether the readings of a levitated record reach the auxiliary bearings.
bool Touches(const RigParameters& rig, const CaseRecord& record);

/// Whether an effect can show in a record. A held rotor does not feel what acts on a free one only,
/// but a delay of the set-points and what turns the surface under a sensor.
bool Feels(const CaseRecord& record, const EffectInstance& effect);

}  // namespace ambrig
