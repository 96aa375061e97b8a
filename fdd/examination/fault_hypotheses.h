#pragma once
/// What each fault hypothesis of coil_examination.h costs: the sum, over the windows of a suspected
/// coil, of its residuals' squares over their variances, each clipped, plus a penalty per free
/// quantity.
#include <vector>

#include "fdd/examination/phase_window.h"

namespace ambrig {

using PhaseWindows = std::vector<PhaseWindow>;

inline constexpr double kClip = 64;  // a window's largest cost: 8 sigma
// 2 ln(60 V / 1 V): a flux that the hypothesis leaves open
inline constexpr double kFreeVoltage = 8;
inline constexpr double kParameter = 4;  // per fitted quantity

/// Of a residual of z standard deviations.
double Cost(double z);

double HealthyCost(const PhaseWindows& all);
double OpenCost(const PhaseWindows& all);
/// The bridge gives the wrong voltage in one phase; `phase`: which one.
double WrongVoltageCost(const PhaseWindows& all, int phase);
/// Least cost of a partial short, and the share of the turns that it leaves.
double BestShort(const PhaseWindows& all, double* turns_left);
/// Both equations hold with the current c i instead of i; `c_found`: the best c.
double SensorCost(const PhaseWindows& all, double* c_found);
/// The reading stands still at a current that is not zero, while the bridge drives.
double FrozenCost(const PhaseWindows& all);

/// Whether a coil with the share `a` of its turns left is far off its own equation: the shorted
/// turns carry a current of their own.
bool LoopCarriesCurrent(const PhaseWindows& all, double a);

}  // namespace ambrig
