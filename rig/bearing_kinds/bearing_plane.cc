#include "rig/bearing_kinds/bearing_plane.h"

#include <cmath>

#include "effects/plant.h"

namespace ambrig {

std::vector<std::string> AxesAcross(const BearingParameters& b) {
  return {b.name + ".x", b.name + ".y"};
}

PlaneMap PlaneAcross(const BearingParameters&, const RotorModel& rotor, double z) {
  return rotor.MakePlane(z);
}

void AddAuxiliaryAtPlane(const BearingParameters& b, RotorModel& rotor) {
  rotor.AddAuxiliary(b.name, std::isnan(b.auxiliary_z) ? b.z : b.auxiliary_z, *b.auxiliary);
}

std::vector<std::string> AxisAlong(const BearingParameters&) { return {"z"}; }

std::array<double, 3> DirectionAlong(const BearingParameters&) { return {0, 0, 1}; }

PlaneMap PlaneAlong(const BearingParameters&, const RotorModel&, double z) {
  PlaneMap map;
  map.z = z;
  map.Add(2, 1, 0);
  return map;
}

void SetAxialStopOf(const BearingParameters& b, RotorModel& rotor) {
  rotor.SetAxialStop(*b.auxiliary);
}

}  // namespace ambrig
