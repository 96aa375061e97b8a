#pragma once
/// Long series made short enough for a browser without losing what a reader looks for: extremes.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ambrig {

struct Points {
  std::vector<double> x, y;
};

inline constexpr std::size_t kMaxPoints = 4000;

/// At most about `max_points` points of y(x), x ascending: each bucket keeps its least and its
/// greatest value in the order they come, and a NaN (a gap) when it has one; ends are kept.
/// Shorter series come back as they are. x and y of one size (Require).
Points Decimate(std::span<const double> x, std::span<const double> y,
                std::size_t max_points = kMaxPoints);

/// For orbits: each bucket keeps the points nearest to and farthest from (0, 0), so that the
/// greatest excursion is never lost.
Points DecimateOrbit(std::span<const double> x, std::span<const double> y,
                     std::size_t max_points = kMaxPoints);

/// `count` times from `start` at `rate` [Hz].
std::vector<double> UniformTime(double start, double rate, std::size_t count);

/// The unit in which the largest of `values` has one to three digits before the point:
/// for 3.6e-5 and "m" {1e6, "µm"}. The factor turns SI into that unit.
struct DisplayUnit {
  double factor = 1;
  std::string name;
};
DisplayUnit ChooseUnit(double largest, std::string_view unit);
double LargestSize(std::span<const double> values);  // NaN and inf ignored; 0 when empty

/// Greatest distance of the points (x, y) from (0, 0); NaN left out, 0 when empty.
double LargestRadius(std::span<const double> x, std::span<const double> y);

std::vector<double> Scaled(std::span<const double> values, double factor);

}  // namespace ambrig
