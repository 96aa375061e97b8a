#include "discovery/search/local_share.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "discovery/search/stage_ratios.h"

namespace ambrig {

namespace {

constexpr double kMostOfTheFall = 0.8;  // of all channels' falls, by those where it acts
constexpr double kShows = 1.15;         // ratio from which unseen records have a say

/// Sums over the channel of one name, in fitted and unseen records.
struct ChannelSums {
  double before[2] = {}, after[2] = {}, rows[2] = {};
  double fall() const { return before[0] - after[0]; }
};

/// Of the error above the noise, from sums of squares.
double ShareOfFall(double before, double after, double rows) {
  return rows > 0 ? ExplainedShare(std::sqrt(before / rows), std::sqrt(after / rows)) : 0;
}

}  // namespace

LocalShare ShareWhereItActs(const CaseModel& model, const std::vector<double>& before,
                            const std::vector<double>& after,
                            const std::function<bool(std::size_t)>& looks_at) {
  std::map<std::string, ChannelSums> channels;
  for (const Target& t : model.targets()) {
    if (looks_at && !looks_at(t.record)) continue;
    const CaseRecord& record = model.data().records[t.record];
    ChannelSums& e = channels[record.data.channels[t.channel].name];
    const int unseen = record.validate ? 1 : 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      e.before[unseen] += before[k] * before[k];
      e.after[unseen] += after[k] * after[k];
      e.rows[unseen] += model.ok()[k];
    }
  }
  std::vector<ChannelSums> most;
  double all = 0;
  for (const auto& [name, e] : channels) {
    most.push_back(e);
    all += std::max(0.0, e.fall());
  }
  std::sort(most.begin(), most.end(),
            [](const ChannelSums& a, const ChannelSums& b) { return a.fall() > b.fall(); });
  ChannelSums sum;
  for (const ChannelSums& e : most) {
    if (!(e.fall() > 0) || sum.fall() >= kMostOfTheFall * all) break;
    for (int q = 0; q < 2; ++q) {
      sum.before[q] += e.before[q];
      sum.after[q] += e.after[q];
      sum.rows[q] += e.rows[q];
    }
  }
  LocalShare out;
  if (!(sum.rows[0] > 0)) return out;
  out.before = std::sqrt(sum.before[0] / sum.rows[0]);
  out.explained = ShareOfFall(sum.before[0], sum.after[0], sum.rows[0]);
  out.seen_there = sum.rows[1] > 0 && sum.before[1] > kShows * kShows * sum.rows[1];
  out.unseen = ShareOfFall(sum.before[1], sum.after[1], sum.rows[1]);
  return out;
}

}  // namespace ambrig
