#pragma once

namespace ambrig {
inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTurn = 2 * kPi;    // [rad]
inline constexpr double kRpm = kPi / 30;    // [rad/s] one turn a minute
inline constexpr double kMu0 = 4e-7 * kPi;  // [H/m]
}  // namespace ambrig
