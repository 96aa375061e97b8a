#pragma once
/// The force that measured currents make at a measured place, by the magnets of the rig file.
#include <array>
#include <optional>
#include <vector>

#include "core/record/record.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

using RadialBearings = std::array<const BearingParameters*, 2>;

/// The rig's two eight-pole bearings; nullopt where it has another number.
std::optional<RadialBearings> TwoEightPoleBearings(const RigParameters& rig);

/// Force on the shaft over time, both directions [N].
struct ForceSeries {
  std::vector<double> x, y;
};

/// Of an eight-pole bearing whose shaft centre is at (x, y) [m], one value per row of the record.
/// nullopt without all of its currents. Source: docs/theory/base_model.md section 2.
std::optional<ForceSeries> MagneticForce(const Record& data, const BearingParameters& bearing,
                                         const std::vector<double>& x,
                                         const std::vector<double>& y);

}  // namespace ambrig
