#include "simulation/sampled/designed_maps.h"

#include "rig/nominal_control.h"

namespace ambrig {

void TakeIntoDesign(const NominalRig& nominal, const ReplaceMap& change,
                    std::vector<CurrentMap>* maps) {
  if (maps->empty())
    for (std::size_t k = 0; k < nominal->bearings.size(); ++k)
      maps->push_back(MakeBearingControl(nominal, k).map);
  CurrentMap& map = (*maps)[change.bearing];
  if (change.map.allocation) {
    map = MakeBearingControl(nominal, change.bearing).map;
    return;
  }
  map = change.map;
  map.W = change.turns_left.asDiagonal() * change.map.W;
}

}  // namespace ambrig
