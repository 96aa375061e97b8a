#include "discovery/shape/shape_names.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "discovery/decision/evidence.h"
#include "discovery/decision/likelihood.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/shape/named_law.h"
#include "discovery/shape/shape_fit.h"
#include "effects/catalogue.h"
#include "effects/usual_size.h"

namespace ambrig {

namespace {

constexpr double kLawIsExact = 1.1;  // ratio to the noise above which a law is asked for its shape
constexpr double kNameContested = 0.02;  // probability of a second name of iron
constexpr double kSomeOfError = 0.2;     // share of the error that a name of iron explains at least
constexpr double kPlainGain = 20;        // of the score: what a free shape gains at least

bool IsIron(const EffectInstance& e) { return IsIronLaw(e.name); }

class ShapeJudge {
 public:
  ShapeJudge(const RoundSetting& setting, const FitResult& now, int round,
             std::vector<RankedEffect>& ranking)
      : s_(setting), now_(now), round_(round), ranking_(ranking) {}

  void Run() {
    const auto best = std::find_if(ranking_.begin(), ranking_.end(),
                                   [&](const RankedEffect& r) { return IsIron(r.effect); });
    if (best == ranking_.end() || !Asked(*best)) return;
    target_ = best->effect.target;
    // other laws than half-order diffusion are missed by the screening: tried in any case
    FitLaw("eddy-currents");
    const auto fit_ranked = [&](auto... names) {
      const auto r = std::find_if(ranking_.begin(), ranking_.end(),
                                  [&](const RankedEffect& e) { return (IsAt(e, names) || ...); });
      if (r != ranking_.end()) FitLaw(std::string(r->effect.name));
    };
    fit_ranked("hysteresis");
    // both are magnetisation curves: the free one belongs to the nearer law
    fit_ranked("saturation", "iron-reluctance");
    std::stable_sort(ranking_.begin(), ranking_.end(),
                     [](const auto& a, const auto& b) { return a.score < b.score; });
    SetProbabilities(now_, ranking_);
  }

 private:
  bool IsAt(const RankedEffect& r, const std::string& name) const {
    return r.effect.name == name && r.effect.target == target_;
  }

  /// Whether the name of iron is plain enough, and contested by other iron; of the first effect also where its law is
  /// not exact: what that leaves may be the law's own.
  bool Asked(const RankedEffect& best) const {
    for (const EffectInstance& e : now_.hypothesis.rig.effects)
      if (IsIron(e) && e.target == best.effect.target) return false;  // two laws of one iron
    if (best.probability < kNameContested ||
        std::max(ExplainedShare(now_.ratio_fit, best.fit.ratio_fit),
                 ExplainedShare(now_.ratio_validate, best.fit.ratio_validate)) < kSomeOfError)
      return false;
    if (round_ == 0 && std::max(best.fit.ratio_fit, best.fit.ratio_validate) > kLawIsExact)
      return true;
    return std::any_of(ranking_.begin(), ranking_.end(), [&](const RankedEffect& r) {
      return &r != &best && IsIron(r.effect) && r.effect.target == best.effect.target &&
             r.probability > kNameContested;
    });
  }

  ShapeReach Reach() {
    if (density_ < 0) density_ = LargestDensity(s_.model, now_.hypothesis, target_);
    ShapeReach reach;
    reach.density = density_;
    return reach;
  }

  void FitLaw(const std::string& name) {
    const auto known = std::find_if(ranking_.begin(), ranking_.end(),
                                    [&](const RankedEffect& r) { return IsAt(r, name); });
    const bool ranked = known != ranking_.end();
    s_.progress(0.97, "shape of " + NameAtTarget(name, target_));
    const std::optional<ShapeFit> shaped =
        FitFrom(ranked ? known->effect : AtUsualSize(EffectNamed(name), target_), !ranked);
    if (!shaped) return;
    const double score = Score(s_.model, shaped->fit, s_.effective_sample_size);
    const StageRatios ratios = {shaped->fit.ratio_fit, shaped->fit.ratio_validate,
                                WorstRecordRatio(s_.model, shaped->fit.residual)};
    if (ranked)
      Take(*known, ratios, score);
    else if (score < ranking_[0].score - kPlainGain)
      Join(name, ratios, score);
  }

  /// The shape that begins at `start`, or at no effect; nothing where the records do not move it.
  std::optional<ShapeFit> FitFrom(const EffectInstance& start, bool at_none) {
    try {
      Shape shape =
          ShapeOf(start, now_.hypothesis.rig, DependsOnFlux(start.name) ? Reach() : ShapeReach());
      if (at_none)
        for (const std::size_t row : shape.rows) shape.effect.values[row] = 0;
      ShapeFitOptions options;
      options.effective_sample_size = s_.effective_sample_size;
      options.base_jacobian = &now_.jacobian;
      options.describe = false;
      ShapeFit fit = FitShape(s_.model, now_.hypothesis, shape, options);
      return fit.fit.converged ? std::optional(std::move(fit)) : std::nullopt;
    } catch (const InputError&) {
      return {};
    }
  }

  static void Take(RankedEffect& r, const StageRatios& ratios, double score) {
    if (score > r.score - kPlainGain) return;
    r.shaped = ratios;
    r.score = score;
  }

  /// The catalogue's law of a name that was not ranked.
  void Join(const std::string& name, const StageRatios& ratios, double score) {
    ScreenOptions what;
    what.effective_sample_size = s_.effective_sample_size;
    what.effect = name;
    what.target = target_;
    RankedEffect r;
    r.fit = FitScreened(s_.model, now_, what);
    if (!r.fit.converged) return;
    r.fit = FitOn(s_.model, now_, r.fit.hypothesis, s_.effective_sample_size);
    if (!r.fit.converged || !HasSize(r.fit, r.fit.hypothesis.rig.effects.size() - 1)) return;
    r.effect = FittedEffect(r.fit, r.fit.hypothesis.rig.effects.size() - 1);
    r.shaped = ratios;
    r.score = score;
    ranking_.push_back(std::move(r));
  }

  const RoundSetting& s_;
  const FitResult& now_;
  int round_;
  std::vector<RankedEffect>& ranking_;
  std::string target_;
  double density_ = -1;  // [T]; below zero: not sought yet
};

}  // namespace

void JudgeByShape(const RoundSetting& setting, const FitResult& now, int round,
                  std::vector<RankedEffect>& ranking) {
  ShapeJudge(setting, now, round, ranking).Run();
}

}  // namespace ambrig
