#include "core/record/time_groups.h"

#include <algorithm>
#include <cmath>

#include "core/base/parameters.h"

namespace ambrig {

namespace {

bool SameBase(const TimedChannel& a, const TimedChannel& b) {
  return a.channel.samples.size() == b.channel.samples.size() &&
         std::abs(a.rate - b.rate) <= 1e-9 * std::abs(a.rate) &&
         std::abs(a.start - b.start) * a.rate <= 1e-3;
}

}  // namespace

Record OneTimeBase(std::vector<TimedChannel> channels, const std::string& path) {
  std::vector<std::pair<const TimedChannel*, std::size_t>> groups;  // first member, members
  for (const TimedChannel& c : channels) {
    const auto it = std::find_if(groups.begin(), groups.end(),
                                 [&c](const auto& g) { return SameBase(*g.first, c); });
    if (it != groups.end())
      ++it->second;
    else
      groups.emplace_back(&c, 1);
  }
  Record record;
  if (groups.empty()) return record;
  const TimedChannel base =
      *std::max_element(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
         return a.second < b.second;
       })->first;
  record.rate = base.rate;
  record.start = base.start;
  for (TimedChannel& c : channels) {
    if (SameBase(base, c))
      record.channels.push_back(std::move(c.channel));
    else
      record.notes.push_back(
          path + ": " + c.channel.name + " has " + std::to_string(c.channel.samples.size()) +
          " rows at " + NumberText(c.rate) + " Hz from " + NumberText(c.start) +
          " s on, others have " + std::to_string(base.channel.samples.size()) + " at " +
          NumberText(base.rate) + " Hz from " + NumberText(base.start) + " s on; left out");
  }
  return record;
}

double RateOfPeriod(double period, int digits) {
  const double rate = 1 / period, whole = std::round(rate);
  if (!(whole >= 1)) return rate;
  // Half a unit of the last digit, of a period whose first digit may be 1.
  const double error = 0.5 * std::pow(10, std::floor(std::log10(period)) - digits + 1);
  return std::abs(1 / whole - period) <= error * (1 + 1e-6) ? whole : rate;
}

}  // namespace ambrig
