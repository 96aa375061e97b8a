#include "core/math/band_order.h"

#include <algorithm>
#include <numeric>

namespace ambrig {

namespace {

/// Unknowns in the order in which a breadth-first search from `start` meets them,
/// few neighbours first.
std::vector<int> SearchFrom(const Neighbours& neighbours, int start, std::vector<bool>& met) {
  std::vector<int> order = {start};
  met[start] = true;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t from = order.size();
    for (const int i : neighbours[order[k]])
      if (!met[i]) met[i] = true, order.push_back(i);
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(from), order.end(), [&](int a, int b) {
      return std::pair(neighbours[a].size(), a) < std::pair(neighbours[b].size(), b);
    });
  }
  return order;
}

}  // namespace

int BandWidth(const Neighbours& neighbours, const std::vector<int>& place) {
  int width = 0;
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    for (const int j : neighbours[i]) width = std::max(width, std::abs(place[i] - place[j]));
  return width;
}

std::vector<int> BandOrder(const Neighbours& neighbours, int enough) {
  std::vector<int> place(neighbours.size());
  std::iota(place.begin(), place.end(), 0);
  if (BandWidth(neighbours, place) <= enough) return place;
  std::vector<bool> met(place.size(), false);
  int next = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (met[i]) continue;
    std::vector<bool> tried = met;
    // the last one that a search meets is an end of the structure
    const int end = SearchFrom(neighbours, static_cast<int>(i), tried).back();
    for (const int k : SearchFrom(neighbours, end, met)) place[k] = next++;
  }
  return place;
}

}  // namespace ambrig
