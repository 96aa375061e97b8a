#include "discovery/data/held_values.h"

#include <algorithm>

namespace ambrig {

namespace {
constexpr std::size_t kLeastFrozen = 20;   // samples
constexpr std::size_t kTimesUsual = 15;    // of the usual stretch
constexpr std::size_t kLeastRegular = 10;  // stretches
}  // namespace

std::vector<HeldStretch> HeldStretches(const std::vector<double>& y, std::size_t least) {
  std::vector<HeldStretch> out;
  for (std::size_t k = 0; k < y.size();) {
    std::size_t end = k + 1;
    while (end < y.size() && y[end] == y[k]) ++end;
    if (end - k >= least) out.push_back({k, end - k, y[k]});
    k = end;
  }
  return out;
}

std::size_t UsualHold(const std::vector<double>& y) {
  std::vector<std::size_t> lengths;
  for (const HeldStretch& s : HeldStretches(y, 1)) lengths.push_back(s.count);
  if (lengths.empty()) return 1;
  std::sort(lengths.begin(), lengths.end());
  return lengths[static_cast<std::size_t>(0.99 * static_cast<double>(lengths.size() - 1))];
}

std::size_t RegularHold(const std::vector<double>& y) {
  const std::vector<HeldStretch> all = HeldStretches(y, 1);
  const std::size_t usual = UsualHold(y);
  const auto same = static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(), [&](const HeldStretch& s) { return s.count == usual; }));
  return all.size() >= kLeastRegular && 10 * same >= 9 * all.size() ? usual : 1;
}

HeldStretch FrozenStretch(const std::vector<double>& y) {
  const std::size_t usual = UsualHold(y);
  HeldStretch longest;
  for (const HeldStretch& s : HeldStretches(y, std::max(kLeastFrozen, kTimesUsual * usual)))
    if (s.count > longest.count) longest = s;
  // what stands still nearly always may do so
  if (10 * longest.count > 9 * y.size()) return {};
  return longest;
}

}  // namespace ambrig
