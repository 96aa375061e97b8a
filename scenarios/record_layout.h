#pragma once
/// The channels of a record in their order, the same for every fidelity (formats.md "Record").
#include "scenarios/recorder.h"
#include "scenarios/rig_file.h"

namespace ambrig {

/// Adds the channels; `clamped` runs have load cells in place of true positions. Returns the
/// indices for Recorder::Put: readings per axis; per bearing currents, set-points, duties, then
/// load cells or true positions; true positions of a beam rotor's stations; omega, theta, bus.
std::vector<std::size_t> AddRecordChannels(Recorder& recorder, const RigParameters& rig,
                                           bool clamped, std::size_t rows);

}  // namespace ambrig
