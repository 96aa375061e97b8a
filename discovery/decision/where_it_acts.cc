#include "discovery/decision/where_it_acts.h"

#include <algorithm>

#include "discovery/decision/decide.h"
#include "discovery/search/local_share.h"

namespace ambrig {

namespace {

/// What an effect has to explain of the error of its channels.
struct Demand {
  double before;             // least ratio there: less may be anything
  double explained, unseen;  // of the error there
  double gain;               // of the score
};
constexpr double kUnseenWorse = 1.05;  // of the ratio on unseen records: no effect makes that
constexpr Demand kNearlyAll = {1.3, 0.8, 0.6, 40}, kAll = {1.1, 0.9, 0.85, 90};

}  // namespace

bool ExplainsItsChannels(const CaseModel& model, const FitResult& before, const FitResult& after,
                         double score_gain, bool first) {
  if (!after.converged || !Believable(after) ||
      after.ratio_validate > kUnseenWorse * std::max(1.0, before.ratio_validate))
    return false;
  const LocalShare share = ShareWhereItActs(model, before.residual, after.residual);
  const auto meets = [&](const Demand& d) {
    return score_gain > d.gain && share.before > d.before && share.explained > d.explained &&
           (!share.seen_there || share.unseen > d.unseen);
  };
  return meets(kAll) || (!first && meets(kNearlyAll));
}

}  // namespace ambrig
