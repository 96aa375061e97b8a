#pragma once
/// Each part of the model fed with measured inputs, so that an error shows where it arises:
///
///   controller   measured readings                  -> set-points
///   coil         measured set-points and readings   -> currents
///   force        measured currents                  -> load cell (clamped rotor)
///   rotor        measured currents and readings     -> unmodelled force
///   sensor       the clamped position               -> readings
///
/// The ratio of a block is its rms error over that of a noisy run of the model itself.
#include <map>
#include <string>

#include "core/record/record.h"
#include "scenarios/scenario.h"

namespace ambrig {

using BlockErrors = std::map<std::string, double>;

/// Rms error of every block that this record can tell.
BlockErrors BlockRms(const RigParameters& rig, const RigParameters& nominal,
                     const Scenario& scenario, const Record& data);

}  // namespace ambrig
