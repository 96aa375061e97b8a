#pragma once
/// Which points nobody beats.
#include <vector>

namespace ambrig {

/// a is nowhere worse than b and somewhere better; both of one size, smaller is better.
bool Dominates(const std::vector<double>& a, const std::vector<double>& b);

/// Indices of the points that no other dominates, ascending; of equal points the first. Points with
/// an infinite value are left out.
std::vector<std::size_t> ParetoFront(const std::vector<std::vector<double>>& points);

/// Of the points `among`, the one whose largest objective over `scales` is least: a compromise.
/// @throws std::logic_error for none.
std::size_t Compromise(const std::vector<std::vector<double>>& points,
                       const std::vector<std::size_t>& among, const std::vector<double>& scales);

}  // namespace ambrig
