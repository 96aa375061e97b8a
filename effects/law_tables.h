#pragma once
/// Sizes of the laws that stand as tables or sums in a rig file, shared with what fits them.
#include <cmath>

namespace ambrig {

inline constexpr int kBhNodes = 13;       // of bh-curve, evenly from 0 to its reach
inline constexpr int kRelaxations = 10;   // of eddy-impedance
inline constexpr int kPlayOperators = 8;  // of play-hysteresis

/// Corner frequency of a relaxation of eddy-impedance, half a decade apart. [Hz]
inline double RelaxationFrequency(int k) { return 5e5 * std::pow(10.0, 0.5 * (k - 9)); }

/// Radius of operator k = 1 .. 8 of play-hysteresis over its width: narrow loops stand close
/// together, because real ones are of many widths.
inline double PlayRadius(int k) {
  return k * k / static_cast<double>(kPlayOperators * kPlayOperators);
}

}  // namespace ambrig
