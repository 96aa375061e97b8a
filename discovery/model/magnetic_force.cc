#include "discovery/model/magnetic_force.h"

#include "actuators/magnetics/radial_stator.h"
#include "core/record/channels.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_channels.h"

namespace ambrig {

std::optional<RadialBearings> TwoEightPoleBearings(const RigParameters& rig) {
  RadialBearings pair{};
  std::size_t found = 0;
  for (const BearingParameters& b : rig.bearings) {
    if (!b.kind->eight_poles) continue;
    if (found < 2) pair[found] = &b;
    ++found;
  }
  return found == 2 ? std::optional(pair) : std::nullopt;
}

std::optional<ForceSeries> MagneticForce(const Record& data, const BearingParameters& bearing,
                                         const std::vector<double>& x,
                                         const std::vector<double>& y) {
  std::vector<const Channel*> current;
  for (const ChannelId& id : ChannelsOf(bearing, ChannelKind::kCoilCurrent)) {
    current.push_back(Find(data, id));
    if (!current.back()) return std::nullopt;
  }
  const RadialStator stator(bearing.radial);
  ForceSeries out;
  for (std::size_t k = 0; k < data.rows(); ++k) {
    CoilVector i;
    for (std::size_t j = 0; j < current.size(); ++j)
      i[static_cast<Eigen::Index>(j)] = current[j]->samples[k];
    const Eigen::Vector2d f = stator.Force({x[k], y[k]}, i);
    out.x.push_back(f.x());
    out.y.push_back(f.y());
  }
  return out;
}

}  // namespace ambrig
