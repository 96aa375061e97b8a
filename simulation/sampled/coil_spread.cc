#include "simulation/sampled/coil_spread.h"

#include <cstdint>

#include "core/math/noise.h"
#include "effects/plant.h"

namespace ambrig {

namespace {
constexpr std::uint32_t kGains = 102, kEdges = 103;  // streams of the generator
}

bool CoilsDiffer(const AmplifierParameters& amplifier) {
  return amplifier.current_gain_spread > 0 || amplifier.edge_spread > 0;
}

void DrawCoilSpread(const RigParameters& rig, Plant* plant) {
  if (!CoilsDiffer(rig.amplifier)) return;
  const auto unit = static_cast<std::uint64_t>(rig.amplifier.unit);
  std::uint64_t coil = 0;
  for (std::size_t k = 0; k < plant->bearings.size(); ++k) {
    BearingPlant& b = plant->bearings[k];
    const CoilErrors& known = rig.bearings[k].coil_errors;
    const double gains = known.current_gain.empty() ? rig.amplifier.current_gain_spread : 0,
                 edges = known.edge.empty() ? rig.amplifier.edge_spread : 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(b.lanes.coils); ++j, ++coil) {
      b.current_sensor[j].gain *= 1 + gains * Normal(unit, kGains, coil);
      b.bridge[j].late_edge += edges * Normal(unit, kEdges, coil);
    }
  }
}

}  // namespace ambrig
