#pragma once
/// What a synthesis asks of a plane of the shaft that has no magnet: a disk's displacement in its
/// cost, forces there among its disturbances. A cost of the bearings' displacements alone pins the
/// shaft there and leaves the bending modes that have their nodes there without damping. Source:
/// Schweitzer, Maslen 2009, chapter 12; Zhou, Doyle, Glover 1996, chapter 9 (generalised plant).
#include <string>

#include "core/base/parameters.h"

namespace ambrig {

struct PlaneWeight {
  std::string at;  // a disk, a station or a bearing of the rig
  double position_weight = 1e-4;
  double force_noise = 0;
};

inline constexpr Field<PlaneWeight> kPlaneWeightFields[] = {
    {"position_weight", &PlaneWeight::position_weight, "m", 1e-9, 1e3,
     "deviation of the plane with unit cost"},
    {"force_noise", &PlaneWeight::force_noise, "N", 0, 1e9,
     "disturbing force there, as force_noise of the bearings"},
};

}  // namespace ambrig
