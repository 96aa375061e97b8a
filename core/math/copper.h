#pragma once
/// Resistance of copper over temperature, R = R20 (1 + kCopperPerKelvin dT).

namespace ambrig {

inline constexpr double kCopperPerKelvin = 0.00393;  // [1/K], at 20 degrees Celsius

}  // namespace ambrig
