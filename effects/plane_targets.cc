#include "effects/plane_targets.h"

namespace ambrig {

BearingPlant& TargetPlane(const EffectInstance& effect, Plant& plant) {
  const std::string name = effect.target.substr(0, effect.target.find('.'));
  if (BearingPlant* b = plant.Find(name)) return *b;
  for (BearingPlant& b : plant.bearings)
    if (name == "z" && b.thrust) return b;
  throw InputError(effect.where + ": " + effect.name + " has no plane \"" + effect.target + "\"");
}

PlaneMap TargetForcePlane(const EffectInstance& effect, Plant& plant) {
  for (const auto& [name, plane] : plant.stations)
    if (name == effect.target) return plane;
  return TargetPlane(effect, plant).plane;
}

int TargetSide(const EffectInstance& effect) {
  const std::string& t = effect.target;
  return t.size() > 2 && t.substr(t.size() - 2) == ".y" ? 1 : 0;
}

std::size_t TargetAuxiliary(const EffectInstance& effect, const Plant& plant) {
  const auto& all = plant.rotor.auxiliaries();
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].name == effect.target) return k;
  throw InputError(effect.where + ": target = \"" + effect.target + "\": " + effect.name +
                   " needs an auxiliary bearing there (bearings." + effect.target + ".auxiliary)");
}

void InsertMap(PositionSensor& sensor, std::unique_ptr<StagedMap> map) {
  auto at = sensor.maps.begin();
  for (; at != sensor.maps.end(); ++at) {
    const auto* other = dynamic_cast<const StagedMap*>(at->get());
    if (other && other->stage() > map->stage()) break;
  }
  sensor.maps.insert(at, std::move(map));
}

}  // namespace ambrig
