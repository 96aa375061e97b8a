#pragma once
/// How many samples of a period come before an instant, every coil's in its lane. Only for sources
/// that hold a hot loop.
#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

/// x to the nearest whole number, x from 0 to 2^51.
template <class V>
[[gnu::always_inline]] inline V Nearest(const V& x) {
  constexpr double kRounds = 6755399441055744.0;  // 1.5 * 2^52: what is added to it has no fraction
  return (x + kRounds) - kRounds;
}

/// How many of the samples 0, 1, ... before `end` come before `x`: x rounded
/// up, within 0 and `end`.
template <class V>
[[gnu::always_inline]] inline V SamplesBefore(const V& x, const V& end) {
  const V within = Min(Max(x, 0.0), end), nearest = Nearest(within);
  return nearest + Only(Below(nearest, within), 1.0);
}

/// How many of them do not come after `x`, from one to `end`.
template <class V>
[[gnu::always_inline]] inline V SamplesUpTo(const V& x, const V& end) {
  const V within = Min(Max(x, 0.0), end - 1.0), nearest = Nearest(within);
  return nearest + Only(~Below(within, nearest), 1.0);
}

}  // namespace ambrig
