#include "discovery/decision/where_it_acts.h"

#include <algorithm>

#include "discovery/decision/decide.h"
#include "discovery/model/record_traits.h"
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

/// Whether the effects that a fit adopted show in a record, and with them the details that their
/// laws leave.
bool FeelsAdopted(const CaseModel& model, const FitResult& fit, const CaseRecord& record) {
  const std::vector<EffectInstance>& effects = fit.hypothesis.rig.effects;
  return std::any_of(effects.begin() + static_cast<std::ptrdiff_t>(model.data().rig.effects.size()),
                     effects.end(), [&](const EffectInstance& e) { return Feels(record, e); });
}

}  // namespace

bool ExplainsItsChannels(const CaseModel& model, const FitResult& before, const FitResult& after,
                         double score_gain, bool first) {
  if (!after.converged || !Believable(after) ||
      after.ratio_validate > kUnseenWorse * std::max(1.0, before.ratio_validate))
    return false;
  const auto meets = [&](const LocalShare& share, const Demand& d) {
    return score_gain > d.gain && share.before > d.before && share.explained > d.explained &&
           (!share.seen_there || share.unseen > d.unseen);
  };
  const LocalShare share = ShareWhereItActs(model, before.residual, after.residual);
  if (meets(share, kAll)) return true;
  if (first) return false;
  return meets(share, kNearlyAll) ||
         meets(ShareWhereItActs(model, before.residual, after.residual,
                                [&](std::size_t r) {
                                  return !FeelsAdopted(model, before, model.data().records[r]);
                                }),
               kNearlyAll);
}

}  // namespace ambrig
