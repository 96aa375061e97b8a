#pragma once
/// What ExcessWindows computes of all coils at once, one lane each.
#include "fdd/learning/commissioned_model.h"

namespace ambrig {

/// sum w d^2 of a coil that is judged, at least.
inline constexpr double kJudgedWeight = 0.5;

/// Directions that are common to the bearing, orthonormal, and one over what they leave of a
/// fault's c in every coil.
struct Projection {
  const Lane* basis;
  int directions;
  const Lane* inverse_share;
};

/// Sums of top and bottom at the end, and before each of the windows that are full.
struct WindowSums {
  const Lane *top, *bottom;
  const Lane *top_before[kExcessWindows], *bottom_before[kExcessWindows];
  int full;
};

/// Bands of |c|, and the limit of a pattern over one window.
struct CalmLimits {
  const Lane* band;
  const double* largest;  // element of each direction
  int window;
  double pattern;
};

/// The sums with one period more; coils with without[j] > 0 add nothing.
void AddPeriodTo(const SlopeExcess& period, const Lane& without, const Lane& last_top,
                 const Lane& last_bottom, Lane* top, Lane* bottom);
/// Raw c of one window from the sums before it and at its end, and its weight.
void RawOfWindow(const Lane& top0, const Lane& bottom0, const Lane& top1, const Lane& bottom1,
                 Lane* c, Lane* bottom);
/// Used c from raw c; 0 where the weight is below `least`.
void UsedOfWindow(const Projection& p, const Lane& c, const Lane& bottom, double least, Lane* used);
/// The same of all full windows.
void UsedOfWindows(const Projection& p, const WindowSums& s, const double* least, Lane* used);
/// Whether surely every raw |c| is within its band and the pattern below its limit.
bool AllBelow(const Projection& p, const WindowSums& s, const CalmLimits& limits);

}  // namespace ambrig
