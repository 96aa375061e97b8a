#pragma once
/// What the bearings can carry and how fast.
///
///   linear    force up to which no set-point is at a limit: 0 <= W [c0, v]' <= i_max, f = k c0 v
///   largest   force of the exact circuit at the centre with set-points clamped, over all commands
///   commanded the controller's f_max
///   slew      k c0 min_j ΔU_j / |L W u|_j: the voltage left in every coil bounds v' = u [N/s]
///   knee      slew / (2π largest usable force): above it a full-size sine is cut [Hz]
///
/// Static capacity: the least over directions of the smaller of linear and f_max, and what the
/// weight leaves of it. Source: base_model.md sections 2 to 4; Schweitzer & Maslen 2009,
/// 3.4.
#include "analysis/linear/operating_point.h"

namespace ambrig {

struct AxisCapacity {
  std::string axis;
  // force per ampere of v [N/A]; negative stiffness [N/m], at the operating point
  double k_i = 0, k_s = 0;
  double linear = 0;          // [N]
  double largest = 0;         // [N]
  double commanded = 0;       // [N]
  double weight = 0;          // carried at rest, signed [N]
  double slew = 0, knee = 0;  // [N/s], [Hz]
  double usable() const;      // static capacity [N]
};

std::vector<AxisCapacity> FindCapacity(const OperatingPoint& point);

}  // namespace ambrig
