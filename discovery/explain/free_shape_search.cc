// Steps of the search: effects that the details of another effect's law hide.
#include <algorithm>

#include "core/base/errors.h"
#include "discovery/decision/conclusion.h"
#include "discovery/decision/likelihood.h"
#include "discovery/decision/where_it_acts.h"
#include "discovery/explain/explanation_search.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/shape/named_law.h"
#include "discovery/shape/shape_fit.h"

namespace ambrig {

namespace {
constexpr double kDetailLeft =
    1.1;  // ratio to the noise above which the details of a law are asked for
// of what the shape leaves, on fitted and unseen records: the least share that a further effect explains
constexpr double kOfTheRest = 0.5;
constexpr double kDetailGain = 20;  // of the score: what a free shape gains at least

/// The sensitivities of a fit without those of one effect.
Eigen::MatrixXd SensitivitiesWithout(const FitResult& fit, std::size_t effect) {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index k = 0; k < fit.jacobian.cols(); ++k)
    if (fit.hypothesis.free[static_cast<std::size_t>(k)].effect != static_cast<int>(effect))
      columns.push_back(k);
  return fit.jacobian(Eigen::all, columns);
}
}  // namespace

/// The fit with the law of one adopted effect in a free shape, all of its sizes free; the best of these effects. Nothing
/// where no shape gains much.
std::optional<FitResult> Explainer::BesideFreeShape(const FitResult& now) const {
  std::optional<FitResult> best;
  double score = ScoreOf(now) - kDetailGain;
  for (std::size_t k = 0; k < out_.adopted.size(); ++k) {
    const EffectInstance& law = out_.adopted[k];
    if ((!IsMotionLaw(law.name) && !IsIronLaw(law.name)) || law.target == "z") continue;
    const std::size_t place = rig_.effects.size() + k;
    const Hypothesis others = WithoutEffect(now.hypothesis, place);
    const Eigen::MatrixXd lent = SensitivitiesWithout(now, place);
    ShapeFitOptions options;
    options.base_jacobian = &lent;
    options.effective_sample_size = out_.effective_sample_size;
    options.describe = false;
    ShapeFit shaped;
    try {
      const Shape shape = ShapeOf(law, others.rig, ReachOf(model_, others, law));
      shaped = FitShape(model_, others, shape, options);
    } catch (const InputError&) {
      continue;  // no record has a reading of what its law depends on
    }
    if (!shaped.fit.converged || ScoreOf(shaped.fit) > score) continue;
    FitResult fit = FitNow(shaped.fit.hypothesis, &lent);
    if (!fit.converged || ScoreOf(fit) > score) continue;
    score = ScoreOf(fit);
    best = std::move(fit);
  }
  return best;
}

/// Adds the effect that explains most beside the free shape of a law found before: what the law leaves of its own details
/// hides it. False: none is worth it there.
bool Explainer::AdoptBesideShape(FitResult& now) {
  const auto round = static_cast<int>(out_.adopted.size());
  if (round == 0 || round >= options_.rounds || Finished(now) ||
      std::max(now.ratio_fit, now.ratio_validate) < kDetailLeft)
    return false;
  Progress(0.84, "effects beside the details of a law");
  const std::optional<FitResult> beside = BesideFreeShape(now);
  if (!beside || Finished(*beside)) return false;
  const EffectRound ranked = RankEffects(SettingFrom(0.84, 0.05), *beside, round);
  for (const RankedEffect& r : ranked.ranking) {
    const std::size_t last = r.fit.hypothesis.rig.effects.size() - 1;
    const EffectInstance found = FittedEffect(r.fit, last);
    if (!HasSize(r.fit, last) || IsDetailOf(out_.adopted, found) ||
        !WorthAdopting(*beside, r.fit, Gain(*beside, r.fit), round, 0) ||
        ExplainedShare(beside->ratio_fit, r.fit.ratio_fit) < kOfTheRest ||
        ExplainedShare(beside->ratio_validate, r.fit.ratio_validate) < kOfTheRest)
      continue;
    Hypothesis h = now.hypothesis;
    h.AddEffect(found);
    FitResult fit = FitOn(model_, now, h, out_.effective_sample_size);
    if (!fit.converged || ScoreOf(fit) > ScoreOf(now)) return false;
    now = std::move(fit);
    out_.adopted.push_back(FittedEffect(now, now.hypothesis.rig.effects.size() - 1));
    out_.ladder.push_back({Named(found), now.ratio_fit, now.ratio_validate});
    out_.second_round = out_.beside[Named(found)] = ranked.ranking;
    out_.shaped = RatiosOf(model_, r.fit);
    beside_shape_.push_back(Named(found));
    NoteRound(ranked.ranking);
    return true;
  }
  return false;
}

bool Explainer::IsBesideShape(const EffectInstance& e) const {
  return std::ranges::count(beside_shape_, Named(e)) > 0;
}

}  // namespace ambrig
