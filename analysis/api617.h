#pragma once
/// Lateral margins of API 617 (8th ed.), for critical speeds found as peaks of the unbalance
/// response:
///   AF < 2.5                    critically damped: no margin required
///   below the lowest speed      SM = 17 (1 - 1/(AF - 1.5)) per cent of the lowest operating speed
///   above the highest speed     SM = 10 + 17 (1 - 1/(AF - 1.5)) per cent of the highest
///   first forward mode          log decrement > 0.1
/// Source: published_values.md 4, with clauses of API RP 684 as another program quotes them; not
/// read in the standards themselves.
namespace ambrig {

struct SeparationMargin {
  double required = 0;  // [%]
  double actual = 0;    // [%] of the nearer operating speed; 0 inside the range
  bool met = true;
};

/// Speeds in one unit; AF, or a bound above it.
SeparationMargin AssessSeparation(double critical, double amplification, double lowest,
                                  double highest);

inline constexpr double kLeastLogDecrement = 0.1;

}  // namespace ambrig
