#pragma once
/// The cross-section of a radial bearing at an instant: yoke, poles coloured by their flux, coils
/// by their current, the shaft displaced within the clearance circle. A schematic: angles are true,
/// radii are not, and the displacement is drawn in proportion to the clearance.
#include <span>
#include <string>
#include <vector>

#include "app/figures/figure.h"

namespace ambrig {

struct StatorView {
  std::string title;                // "A, 0.3 ms after the fault"
  std::string bearing;              // "A": names the coils A1 ...
  std::vector<double> pole_angles;  // γ_j [rad]
  std::vector<double> flux;         // into the rotor positive [Wb]; empty: of no instant
  std::vector<double> current;      // [A], empty: coils are not coloured
  std::vector<int> failed;          // 1-based coil numbers
  double clearance = 0;             // [m]
  double x = 0, y = 0;              // shaft centre [m]
};

/// One panel per view, colours on one common scale. Angles and fluxes of one size (Require).
Figure StatorFigure(std::string caption, std::span<const StatorView> views);

}  // namespace ambrig
