#include "discovery/model/record_order.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "simulation/sampled/start_state.h"

namespace ambrig {

namespace {

constexpr double kContact = 3;  // times as long: the rotor takes many short steps

/// Simulated seconds [s], those of a rotor in contact counted more.
double Effort(const CaseRecord& r, bool touches) {
  if (!OverTime(r)) return 0;
  const double warm_up = r.scenario.start == StartState::kLevitated ? kLevitatedWarmUp : 0;
  return warm_up + r.scenario.duration * (touches ? kContact : 1);
}

}  // namespace

std::vector<std::size_t> LongestFirst(const Case& c, const std::vector<char>& touches) {
  std::vector<std::size_t> order(c.records.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t r) { return Effort(c.records[r], touches[r] != 0); });
  return order;
}

}  // namespace ambrig
