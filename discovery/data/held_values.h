#pragma once
/// Stretches in which a column repeats one value: a logger that froze, a converter at its limit.
#include <cstddef>
#include <vector>

namespace ambrig {

struct HeldStretch {
  std::size_t first = 0, count = 0;  // samples
  double value = 0;
};

/// Stretches of at least `least` equal neighbours, in order.
std::vector<HeldStretch> HeldStretches(const std::vector<double>& y, std::size_t least);

/// The length that 99 of 100 stretches of equal neighbours do not exceed, 1 for a column that never
/// repeats: what its converter's steps make of it.
std::size_t UsualHold(const std::vector<double>& y);

/// The length of the stretches of equal neighbours where nine of ten have the same, as of a reading
/// that a faster record repeats; 1 otherwise, and for fewer than ten stretches.
std::size_t RegularHold(const std::vector<double>& y);

/// The longest stretch that is far longer than this column's usual ones, at least 20 samples; count
/// 0: none. A column that stands still for most of its rows has no freeze.
HeldStretch FrozenStretch(const std::vector<double>& y);

}  // namespace ambrig
