#pragma once
/// When two instants of the simulated clocks are one: an event that falls together with the
/// end of a step by the equations may be computed a rounding before or after it.

namespace ambrig {

/// Of times since the start [s]: at 10^4 s a double is rounded by 2e-12 s, and sums of periods and
/// delays by a few times as much. Nothing that is meant is that short: an ADC sample takes 1e-6 s.
inline constexpr double kSameTime = 1e-10;

/// Of instants inside one switching period [s]: counted from its beginning they
/// are rounded by 1e-20 s, as a difference of times since the start by 1e-14 s within
/// the first minute.
inline constexpr double kSameInstant = 1e-14;

}  // namespace ambrig
