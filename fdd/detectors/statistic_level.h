#pragma once
/// Statistics on a fixed logarithmic scale, so that thresholds can be swept over what was counted:
/// level k holds values from ValueOf(k) up to ValueOf(k + 1), 32 levels a decade (7.5 % apart) from
/// 1e-3 to 1e7; level 0 is everything below, the last one everything above.
namespace ambrig {

inline constexpr int kLevelsPerDecade = 32, kStatisticLevels = 10 * kLevelsPerDecade + 1;

/// Of a statistic, nan counts as infinite.
int LevelOf(double statistic);
/// Lowest level all of whose values are at or above a threshold.
int LevelAtLeast(double threshold);
/// Smallest value of a level; 0 for level 0.
double ValueOf(int level);

}  // namespace ambrig
