#pragma once

namespace ambrig {
inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kMu0 = 4e-7 * kPi;  // [H/m]
}  // namespace ambrig
