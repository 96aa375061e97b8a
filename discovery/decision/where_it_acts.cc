#include "discovery/decision/where_it_acts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "discovery/decision/decide.h"
#include "discovery/model/residual.h"

namespace ambrig {

namespace {

constexpr double kMostOfTheFall = 0.8;  // of all channels' falls, by those where it acts
constexpr double kShows = 1.15;         // ratio from which unseen records have a say

/// What an effect has to explain of the error of its channels.
struct Demand {
  double before;             // least ratio there: less may be anything
  double explained, unseen;  // of the error there
  double gain;               // of the score
};
constexpr Demand kNearlyAll = {1.3, 0.8, 0.6, 40}, kAll = {1.1, 0.9, 0.85, 90};

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

LocalShare ShareWhereItActs(const CaseModel& model, const FitResult& before,
                            const FitResult& after) {
  std::map<std::string, ChannelSums> channels;
  for (const Target& t : model.targets()) {
    const CaseRecord& record = model.data().records[t.record];
    ChannelSums& e = channels[record.data.channels[t.channel].name];
    const int unseen = record.validate ? 1 : 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      e.before[unseen] += before.residual[k] * before.residual[k];
      e.after[unseen] += after.residual[k] * after.residual[k];
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

bool ExplainsItsChannels(const CaseModel& model, const FitResult& before, const FitResult& after,
                         double score_gain, bool first) {
  if (!after.converged || !Believable(after)) return false;
  const LocalShare share = ShareWhereItActs(model, before, after);
  const auto meets = [&](const Demand& d) {
    return score_gain > d.gain && share.before > d.before && share.explained > d.explained &&
           (!share.seen_there || share.unseen > d.unseen);
  };
  return meets(kAll) || (!first && meets(kNearlyAll));
}

}  // namespace ambrig
