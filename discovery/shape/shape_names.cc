#include "discovery/shape/shape_names.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "discovery/decision/evidence.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/likelihood.h"
#include "discovery/shape/named_law.h"
#include "discovery/shape/shape_fit.h"
#include "effects/catalogue.h"
#include "effects/usual_size.h"

namespace ambrig {

namespace {

constexpr double kLawIsExact = 1.1;  // ratio to the noise above which a law is asked for its shape
constexpr double kNameContested = 0.02;  // probability of a name that is asked
constexpr double kSomeOfError = 0.2;     // share of the error that a name explains at least
constexpr double kPlainGain = 20;        // of the score: what a free shape gains at least
constexpr double kBothLaws = 0.1;  // share of the iron's MMF by which a second law is one more name

bool IsIron(const EffectInstance& e) { return IsIronLaw(e.name); }

class ShapeJudge {
 public:
  ShapeJudge(const RoundSetting& setting, const FitResult& now, int round,
             std::vector<RankedEffect>& ranking)
      : s_(setting), now_(now), round_(round), ranking_(ranking) {}

  void Run() {
    JudgeIron();
    if (round_ == 0) JudgeMotion();
    if (!judged_) return;
    SortByScore(ranking_);
    SetProbabilities(now_, ranking_);
  }

 private:
  void JudgeIron() {
    const auto best = std::find_if(ranking_.begin(), ranking_.end(),
                                   [&](const RankedEffect& r) { return IsIron(r.effect); });
    if (best == ranking_.end() || !IronIsAsked(*best)) return;
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
    if (!curve_.empty()) ShareCurve();
  }

  /// A magnetisation curve that neither law follows, which starts with a slope and rises from
  /// there, is of both names: each as probable as the part of the MMF that is its own, the nearer
  /// law not less than the other.
  void ShareCurve() {
    auto nearer = std::find_if(ranking_.begin(), ranking_.end(), [&](const RankedEffect& r) {
      return r.shaped && (IsAt(r, "saturation") || IsAt(r, "iron-reluctance"));
    });
    if (nearer == ranking_.end()) return;
    const bool saturates = nearer->effect.name == "saturation";
    const double rise = SaturatingShare(curve_), part = std::min(0.5, saturates ? 1 - rise : rise);
    if (part < kBothLaws) return;
    const std::string other = saturates ? "iron-reluctance" : "saturation";
    nearer->shares_curve = true;
    const double score = nearer->score + 2 * std::log((1 - part) / part);
    const std::optional<StageRatios> left = nearer->shaped;
    const auto known = std::find_if(ranking_.begin(), ranking_.end(),
                                    [&](const RankedEffect& r) { return IsAt(r, other); });
    if (known == ranking_.end()) {
      if (Join(other, left, score)) ranking_.back().shares_curve = true;
      return;
    }
    known->score = std::min(known->score, score);
    known->shaped = left;
    known->shares_curve = true;
  }

  /// Forces and drags that are plain enough, and whose law is not exact.
  void JudgeMotion() {
    for (RankedEffect& r : ranking_)
      // a pull that holds the shaft back is another physics, in whatever shape
      if (IsMotionLaw(r.effect.name) && IsPlain(r) && IsInexact(r.fit) &&
          !HasImpossibleSign(r.effect))
        TakeShapeOf(r);
  }

  bool IsAt(const RankedEffect& r, const std::string& name) const {
    return r.effect.name == name && r.effect.target == target_;
  }

  /// Whether a name is probable enough to be asked for its shape, and explains enough.
  bool IsPlain(const RankedEffect& r) const {
    return r.probability >= kNameContested &&
           std::max(ExplainedShare(now_.ratio_fit, r.fit.ratio_fit),
                    ExplainedShare(now_.ratio_validate, r.fit.ratio_validate)) >= kSomeOfError;
  }

  static bool IsInexact(const FitResult& fit) {
    return std::max(fit.ratio_fit, fit.ratio_validate) > kLawIsExact;
  }

  /// Whether the name of iron is plain enough, and contested by other iron; of the first effect
  /// also where its law is not exact: what that leaves may be the law's own.
  bool IronIsAsked(const RankedEffect& best) const {
    for (const EffectInstance& e : now_.hypothesis.rig.effects)
      if (IsIron(e) && e.target == best.effect.target) return false;  // two laws of one iron
    if (!IsPlain(best)) return false;
    if (round_ == 0 && IsInexact(best.fit)) return true;
    return std::any_of(ranking_.begin(), ranking_.end(), [&](const RankedEffect& r) {
      return &r != &best && IsIron(r.effect) && r.effect.target == best.effect.target &&
             r.probability > kNameContested;
    });
  }

  /// That of the iron's flux density, which takes simulations, is sought once.
  ShapeReach Reach(const EffectInstance& named) {
    if (!DependsOnFlux(named.name)) return ReachOf(s_.model, now_.hypothesis, named);
    if (!iron_) iron_ = ReachOf(s_.model, now_.hypothesis, named);
    return *iron_;
  }

  void FitLaw(const std::string& name) {
    const auto known = std::find_if(ranking_.begin(), ranking_.end(),
                                    [&](const RankedEffect& r) { return IsAt(r, name); });
    judged_ = true;
    if (known != ranking_.end()) {
      TakeShapeOf(*known);
      return;
    }
    const std::optional<Shaped> shaped = FitFrom(AtUsualSize(EffectNamed(name), target_), true);
    if (shaped && shaped->score < ranking_[0].score - kPlainGain)
      Join(name, shaped->left, shaped->score);
  }

  /// The error that the free shape of a ranked name leaves counts where it is plainly less.
  void TakeShapeOf(RankedEffect& r) {
    judged_ = true;
    const std::optional<Shaped> shaped = FitFrom(r.effect, false);
    if (!shaped || shaped->score > r.score - kPlainGain) return;
    r.shaped = shaped->left;
    r.score = shaped->score;
    if (ShareMagnetisation(r.effect.name, r.effect.name)) curve_ = shaped->sizes;
  }

  struct Shaped {
    StageRatios left;
    double score = 0;
    std::vector<double> sizes;
  };

  /// The shape that begins at `start`, or at no effect; nothing where the records do not move it.
  std::optional<Shaped> FitFrom(const EffectInstance& start, bool at_none) {
    s_.progress(0.97, "shape of " + Named(start));
    try {
      Shape shape = ShapeOf(start, now_.hypothesis.rig, Reach(start));
      if (at_none)
        for (const std::size_t row : shape.rows) shape.effect.values[row] = 0;
      ShapeFitOptions options;
      options.effective_sample_size = s_.effective_sample_size;
      options.base_jacobian = &now_.jacobian;
      options.describe = false;
      const ShapeFit found = FitShape(s_.model, now_.hypothesis, shape, options);
      const FitResult& fit = found.fit;
      if (!fit.converged) return {};
      return Shaped{{fit.ratio_fit, fit.ratio_validate, WorstRecordRatio(s_.model, fit.residual)},
                    Score(s_.model, fit, s_.effective_sample_size),
                    found.sizes};
    } catch (const InputError&) {
      return {};
    }
  }

  /// The catalogue's law of a name that was not ranked, with a score of its own. Whether it has a
  /// size.
  bool Join(const std::string& name, const std::optional<StageRatios>& shaped, double score) {
    ScreenOptions what;
    what.effective_sample_size = s_.effective_sample_size;
    what.effect = name;
    what.target = target_;
    RankedEffect r;
    r.fit = FitScreened(s_.model, now_, what);
    if (!r.fit.converged) return false;
    r.fit = FitOn(s_.model, now_, r.fit.hypothesis, s_.effective_sample_size);
    if (!r.fit.converged || !HasSize(r.fit, r.fit.hypothesis.rig.effects.size() - 1)) return false;
    r.effect = FittedEffect(r.fit, r.fit.hypothesis.rig.effects.size() - 1);
    r.shaped = shaped;
    r.score = score;
    ranking_.push_back(std::move(r));
    return true;
  }

  const RoundSetting& s_;
  const FitResult& now_;
  int round_;
  std::vector<RankedEffect>& ranking_;
  std::string target_;              // of the iron
  std::optional<ShapeReach> iron_;  // of the bearing target_
  std::vector<double> curve_;       // incremental path of the free magnetisation curve [m]
  bool judged_ = false;
};

}  // namespace

void JudgeByShape(const RoundSetting& setting, const FitResult& now, int round,
                  std::vector<RankedEffect>& ranking) {
  ShapeJudge(setting, now, round, ranking).Run();
}

}  // namespace ambrig
