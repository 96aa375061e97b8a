#pragma once
/// What a run leaves out of a beam: the bending modes above `modes` of its [rotor]. A force at a
/// magnet moves the shaft at the sensor by
///   sum phi_k(z_magnet) phi_k(z_sensor)/(w_k² - w²)   over the bending modes k
/// and the part of the dropped ones is their residual compliance, static (w = 0) and at the highest
/// mode that is kept. With `static_correction` residual modes (rotor/shaft/residual_modes.h) carry
/// the static part; lost is what they do not. Rigid motion and damping left out. Linear analyses of
/// a shaft (analysis/shaft) drop nothing.
#include <optional>
#include <string>
#include <vector>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct LostCompliance {
  std::string bearing;
  double kept = 0, lost = 0;  // static, from the magnet to the sensor [m/N]
  double lost_at_top = 0;     // at the highest mode that is kept [m/N]
};

struct DroppedModes {
  int kept = 0, dropped = 0;
  double top = 0;                 // of the kept, 0: none [Hz]
  std::vector<double> frequency;  // the lowest dropped, at most four [Hz]
  std::vector<LostCompliance> bearings;
  std::vector<double> residual;  // frequencies of the residual modes [Hz]
};

/// Nothing for a rotor that is no beam.
std::optional<DroppedModes> FindDroppedModes(const RigParameters& rig);

/// In one sentence.
std::string DroppedModesText(const DroppedModes& modes);

}  // namespace ambrig
