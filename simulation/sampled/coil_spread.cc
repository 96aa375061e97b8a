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

void DrawCoilSpread(const AmplifierParameters& amplifier, Plant* plant) {
  if (!CoilsDiffer(amplifier)) return;
  const auto unit = static_cast<std::uint64_t>(amplifier.unit);
  std::uint64_t coil = 0;
  for (BearingPlant& b : plant->bearings)
    for (std::size_t j = 0; j < static_cast<std::size_t>(b.lanes.coils); ++j, ++coil) {
      b.current_sensor[j].gain *= 1 + amplifier.current_gain_spread * Normal(unit, kGains, coil);
      b.bridge[j].late_edge += amplifier.edge_spread * Normal(unit, kEdges, coil);
    }
}

}  // namespace ambrig
