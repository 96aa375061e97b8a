#include "discovery/explain/effect_beside_shape.h"

#include <algorithm>

#include "core/base/errors.h"
#include "discovery/decision/conclusion.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/shape/named_law.h"
#include "discovery/shape/shape_fit.h"

namespace ambrig {

namespace {

// ratio to the noise above which the details of a law are asked for
constexpr double kDetailLeft = 1.1;
// of what the shape leaves, on fitted and unseen records: the least share that a further effect
// explains
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

std::optional<FitResult> EffectBesideShape::BesideFreeShape(const FitResult& now) const {
  const CaseModel& model = models_.thinned();
  std::optional<FitResult> best;
  double score = models_.ScoreOf(now) - kDetailGain;
  for (std::size_t k = 0; k < adopted_.size(); ++k) {
    const EffectInstance& law = adopted_[k];
    if ((!IsMotionLaw(law.name) && !IsIronLaw(law.name)) || law.target == "z") continue;
    const std::size_t place = adopted_.PlaceOf(k);
    const Hypothesis others = WithoutEffect(now.hypothesis, place);
    const Eigen::MatrixXd lent = SensitivitiesWithout(now, place);
    ShapeFitOptions options;
    options.base_jacobian = &lent;
    options.effective_sample_size = models_.effective_sample_size();
    options.describe = false;
    ShapeFit shaped;
    try {
      const Shape shape = ShapeOf(law, others.rig, ReachOf(model, others, law));
      shaped = FitShape(model, others, shape, options);
    } catch (const InputError&) {
      continue;  // no record has a reading of what its law depends on
    }
    if (!shaped.fit.converged || models_.ScoreOf(shaped.fit) > score) continue;
    FitResult fit = models_.FitFrom(shaped.fit.hypothesis, &lent);
    if (!fit.converged || models_.ScoreOf(fit) > score) continue;
    score = models_.ScoreOf(fit);
    best = std::move(fit);
  }
  return best;
}

bool EffectBesideShape::IsWorthIt(const FitResult& beside, const RankedEffect& ranked,
                                  int round) const {
  const FitResult& fit = ranked.fit;
  const std::size_t last = fit.hypothesis.rig.effects.size() - 1;
  return HasSize(fit, last) && !IsDetailOf(adopted_.all(), FittedEffect(fit, last)) &&
         WorthAdopting(beside, fit, models_.Gain(beside, fit), round, 0) &&
         ExplainedShare(beside.ratio_fit, fit.ratio_fit) >= kOfTheRest &&
         ExplainedShare(beside.ratio_validate, fit.ratio_validate) >= kOfTheRest;
}

bool EffectBesideShape::Adopt(FitResult& now) {
  const auto round = static_cast<int>(adopted_.size());
  if (round == 0 || round >= options_.rounds || selection_.Finished(now) ||
      std::max(now.ratio_fit, now.ratio_validate) < kDetailLeft)
    return false;
  progress_(0.84, "effects beside the details of a law");
  const std::optional<FitResult> beside = BesideFreeShape(now);
  if (!beside || selection_.Finished(*beside)) return false;
  const EffectRound ranked =
      RankEffects(models_.Round(options_.candidates, progress_.Part(0.84, 0.05)), *beside, round);
  const auto best = std::ranges::find_if(
      ranked.ranking, [&](const RankedEffect& r) { return IsWorthIt(*beside, r, round); });
  if (best == ranked.ranking.end()) return false;
  const EffectInstance found = FittedEffect(best->fit, best->fit.hypothesis.rig.effects.size() - 1);
  Hypothesis h = now.hypothesis;
  h.AddEffect(found);
  FitResult fit = FitOn(models_.thinned(), now, h, models_.effective_sample_size());
  if (!fit.converged || models_.ScoreOf(fit) > models_.ScoreOf(now)) return false;
  now = std::move(fit);
  adopted_.AddLastOf(now);
  log_.Step(Named(found), now);
  adopted_.shaped = RatiosOf(models_.thinned(), best->fit);
  adopted_.NoteBesideShape(found);
  names_.NoteRoundBesideShape(found, ranked.ranking);
  return true;
}

}  // namespace ambrig
