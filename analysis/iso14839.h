#pragma once
/// Zones of ISO 14839 for active magnetic bearings.
///   part 2 (2004)  D_max / C_min, largest displacement over least clearance:  A/B 0.3, B/C 0.4,
///     C/D 0.5
///   part 3 (2006)  peak of |S| per axis, 0 Hz to max(3 rated speeds, 2 kHz):   A/B 3,   B/C 4,
///     C/D 5
/// A: new machines; B: long-term operation; C: for a limited time; D: damage is to be expected.
#include <algorithm>

namespace ambrig {

inline char ZoneOf(double value, double ab, double bc, double cd) {
  return value <= ab ? 'A' : value <= bc ? 'B' : value <= cd ? 'C' : 'D';
}
inline char DisplacementZone(double ratio) { return ZoneOf(ratio, 0.3, 0.4, 0.5); }
inline char SensitivityZone(double peak) { return ZoneOf(peak, 3, 4, 5); }

/// Highest frequency of part 3's evaluation [Hz]; `rated` [Hz].
inline double SensitivityRange(double rated) { return std::max(3 * rated, 2000.0); }

}  // namespace ambrig
