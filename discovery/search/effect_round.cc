#include "discovery/search/effect_round.h"

#include <algorithm>
#include <functional>

#include "discovery/search/candidate_fit.h"
#include "discovery/search/candidate_promise.h"
#include "discovery/search/likelihood.h"
#include "discovery/search/residual_peaks.h"
#include "discovery/search/worst_records.h"

namespace ambrig {

namespace {

constexpr double kResonanceShows = 1.1;  // least ratio at which a later round seeks frequencies
constexpr double kRivalExplains = 0.5;   // of the error above the noise
constexpr double kOpenShare =
    0.2;  // what a full fit may still gain of what the best fit has gained

/// The best fit so far explains nearly all, and this candidate promises far less.
bool Decided(const FitResult& now, const std::vector<RankedEffect>& ranking,
             const Candidate& next) {
  constexpr double kAtFloor = 0.02;  // of the squared ratio
  if (ranking.size() < 2) return false;
  const auto best = std::min_element(
      ranking.begin(), ranking.end(),
      [](const auto& a, const auto& b) { return a.fit.ratio_validate < b.fit.ratio_validate; });
  const double left = best->fit.ratio_validate * best->fit.ratio_validate - 1;
  return ExplainedShare(now.ratio_validate, best->fit.ratio_validate) > 0.9 &&
         next.ratio_validate * next.ratio_validate - 1 > 4 * std::max(left, kAtFloor);
}

bool HoldSameEffects(const Hypothesis& a, const Hypothesis& b) {
  return std::ranges::equal(a.rig.effects, b.rig.effects, IsSameName);
}

class Ranker {
 public:
  Ranker(const RoundSetting& s, const FitResult& now, int round)
      : s_(s), now_(now), round_(round) {}

  EffectRound Run() {
    ScreenOptions screen;
    screen.effective_sample_size = s_.effective_sample_size;
    screen.frequencies =
        round_ == 0 || std::max(now_.ratio_fit, now_.ratio_validate) > kResonanceShows;
    // A resonance moves the rotor: where readings and set-points are explained there is none to
    // seek, however much the currents leave. Responses and static tables may show it otherwise.
    screen.resonances = shows_motion_;
    screen.progress = [&](double f, const std::string& text) {
      s_.progress(0.6 * f, "screening " + text);
    };
    const auto predicted = s_.full.Predict(now_.hypothesis);
    const ResidualPeaks peaks =
        predicted ? FindPeaks(s_.full, Residual(s_.full, *predicted)) : ResidualPeaks();
    if (MayBeStale() && s_.bank.LacksHalfOf(RecordsShowing(s_.model, now_)))
      s_.bank = SignatureBank();
    out_.screened = Screen(s_.model, now_, peaks, screen, s_.bank);
    if (AreStale()) {
      s_.bank = SignatureBank();
      out_.screened = Screen(s_.model, now_, peaks, screen, s_.bank);
    }
    ScreenFromNominal();
    FitThePromising();
    SortByScore(ranking_);
    FitRivalsOfTheBest();
    SortByScore(ranking_);
    ContinueTheNext();
    SortByScore(ranking_);
    FitToTheEnd();
    SortByScore(ranking_);
    if (!ranking_.empty() && ranking_[0].fit.jacobian.size() == 0) {
      ranking_[0].fit = FitOn(s_.model, now_, ranking_[0].fit.hypothesis, s_.effective_sample_size);
      Note(ranking_[0]);
    }
    SetProbabilities(now_, ranking_);
    return std::move(out_);
  }

 private:
  /// Whether signatures were taken without what has been adopted since, and much is left.
  bool MayBeStale() const {
    constexpr double kMuch = 2;  // ratio
    return round_ > 0 && std::min(now_.ratio_fit, now_.ratio_validate) >= kMuch &&
           std::ranges::any_of(s_.bank.entries(), [&](const SignatureBank::Entry& e) {
             return !HoldSameEffects(*e.base, now_.hypothesis);
           });
  }

  /// A lag of the readings shows only in a shaft that moves: where much is left and no signature of
  /// an earlier model promises half of it, all are taken again.
  bool AreStale() const {
    constexpr double kHalf = 0.5;  // share of the error
    if (!MayBeStale()) return false;
    const auto share = [&](const Candidate& c) {
      return std::min(ExplainedShare(now_.ratio_fit, c.ratio_fit),
                      ExplainedShare(now_.ratio_validate, c.ratio_validate));
    };
    return std::ranges::none_of(out_.screened,
                                [&](const Candidate& c) { return share(c) > kHalf; });
  }

  /// Rig parameters that had to move far may stand in for an effect that changes what they change
  /// (a longer gap for the reluctance of the iron). The fit so far then leaves little to show that
  /// effect; the rig file's own parameters do.
  void ScreenFromNominal() {
    constexpr double kFar = 4;         // [sd]
    constexpr std::size_t kTried = 3;  // effects
    if (LargestShift(now_.hypothesis) < kFar) return;
    FitOptions point;
    point.iterations = 0;
    point.effective_sample_size = s_.effective_sample_size;
    const RigParameters& file = s_.model.data().rig;
    Hypothesis nominal = Hypothesis::Base(file);
    const std::vector<EffectInstance>& effects = now_.hypothesis.rig.effects;
    for (std::size_t k = file.effects.size(); k < effects.size(); ++k)
      nominal.AddEffect(effects[k]);
    nominal_ = Fit(s_.model, nominal, point);
    if (!nominal_.Stands()) return;
    ScreenOptions screen;
    screen.effective_sample_size = s_.effective_sample_size;
    screen.coarse = true;
    // The signatures of the fit so far serve: what an effect changes depends little on the shifts.
    std::vector<Candidate> found = Screen(s_.model, nominal_, ResidualPeaks(), screen, s_.bank);
    // beside effects one linear step brings far parameters back only in part
    if (round_ == 0) std::erase_if(found, [&](const Candidate& c) { return c.score > here_; });
    found.resize(std::min(found.size(), kTried));
    for (Candidate& c : found) c.from_nominal = true;
    out_.screened.insert(out_.screened.begin(), found.begin(), found.end());
  }

  void FitThePromising() {
    const std::vector<Candidate>& candidates = out_.screened;
    std::size_t next = 0;
    for (; next < candidates.size() && static_cast<int>(ranking_.size()) < s_.candidates; ++next) {
      const Candidate& c = candidates[next];
      // Hopeless ones need no full fit, but a user wants to see a few beside the best.
      if (c.score > here_ && !c.from_nominal && (ranking_.size() >= 2 || round_ > 0)) break;
      if (Decided(now_, ranking_, c)) continue;
      if (round_ == 0 || c.from_nominal || Promising(now_, c)) FitTheStart(c);
    }
    FitTheLocal();
    // A resonance shows only when it is fitted; later rounds try that where much is left.
    for (; next < candidates.size() &&
           (round_ == 0 || (motion_ > 0 ? motion_ : now_.ratio_validate) > 1.3);
         ++next)
      if (candidates[next].narrow && !Decided(now_, ranking_, candidates[next]))
        FitTheStart(candidates[next]);
  }

  /// Of later rounds: effects that explain most of what is left where they act.
  void FitTheLocal() {
    constexpr std::size_t kTried = 3;
    constexpr double kLeastOfScore = 20;  // of the score, less is never adopted
    if (round_ == 0) return;
    const LinearJudge judge(s_.model, now_, s_.bank, s_.effective_sample_size);
    std::vector<std::pair<double, const Candidate*>> local;
    for (const Candidate& c : out_.screened) {
      if (c.narrow || c.from_nominal || c.score > here_ - kLeastOfScore || Ranked(c.effect))
        continue;
      const LocalShare share = judge.ShareWhereItActs(s_.bank.entries()[c.entry]);
      if (PromisesItsChannels(share)) local.emplace_back(share.explained, &c);
    }
    std::ranges::stable_sort(local, std::greater{}, [](const auto& l) { return l.first; });
    local.resize(std::min(local.size(), kTried));
    for (const auto& [explained, c] : local) FitTheStart(*c);
  }

  /// Other laws at the place of the best: their linear promise says little of how they compare, and
  /// a name given without them would be too sure.
  void FitRivalsOfTheBest() {
    constexpr int kRivals = 3;
    constexpr double kSome = 0.3;  // of the error above the noise, by the linear promise
    if (ranking_.empty()) return;
    const EffectInstance best = ranking_[0].effect;
    int fitted = 0;
    for (const Candidate& c : out_.screened) {
      if (c.effect.target != best.target || c.narrow || Ranked(c.effect) || fitted == kRivals)
        continue;
      if (std::max(ExplainedShare(now_.ratio_fit, c.ratio_fit),
                   ExplainedShare(now_.ratio_validate, c.ratio_validate)) < kSome)
        continue;
      FitTheStart(c);
      ++fitted;
    }
  }

  bool Ranked(const EffectInstance& e) const {
    return std::any_of(ranking_.begin(), ranking_.end(),
                       [&](const RankedEffect& r) { return IsSameName(r.effect, e); });
  }

  void FitTheStart(const Candidate& c) {
    s_.progress(0.6 + 0.07 * std::min(4.0, static_cast<double>(ranking_.size())),
                "fitting " + Named(c.effect));
    RankedEffect r;
    r.fit = FitBriefly(s_.model, c.from_nominal ? nominal_ : now_, c, s_.effective_sample_size);
    r.screened_ratio = c.ratio_validate;
    if (!r.fit.converged) return;
    Note(r);
    r.from_nominal = c.from_nominal;
    if (round_ > 0 && r.from_nominal) Continue(r);
    const auto same = std::ranges::find_if(
        ranking_, [&](const RankedEffect& o) { return IsSameName(o.effect, r.effect); });
    if (same == ranking_.end())
      ranking_.push_back(std::move(r));
    else if (r.score < same->score)
      *same = std::move(r);
  }

  /// A short fit may end on the way, and where both the best and the next explain most of the
  /// error, which of them it is that did says nothing: the next go on while that gains.
  void ContinueTheNext() {
    constexpr std::size_t kNext = 2;
    for (std::size_t k = 1; k < std::min(ranking_.size(), 1 + kNext); ++k) Continue(ranking_[k]);
  }

  void Continue(RankedEffect& r) {
    constexpr int kTimes = 2;
    for (int time = 0; time < kTimes; ++time) {
      if (ExplainedShare(BothRatios(now_), BothRatios(r.fit)) < kRivalExplains && !r.from_nominal)
        return;
      RankedEffect more;
      more.from_nominal = r.from_nominal;
      more.screened_ratio = r.screened_ratio;
      more.fit = FitShortly(s_.model, now_, r.fit.hypothesis, s_.effective_sample_size);
      if (!more.fit.converged) return;
      Note(more);
      const double gain = r.score - more.score;
      if (gain > 0) r = std::move(more);
      if (gain < kOpenAfterShortFit) return;
    }
  }

  /// The best, and the next where the short fits left it open.
  void FitToTheEnd() {
    if (ranking_.empty()) return;
    const double open = std::max(kOpenAfterShortFit, kOpenShare * (here_ - ranking_[0].score));
    for (std::size_t k = 0; k < std::min<std::size_t>(ranking_.size(), 2); ++k) {
      if (k > 0 && ranking_[k].score > ranking_[0].score + open) break;
      s_.progress(0.95, "full fit of " + Named(ranking_[k].effect));
      FitResult fit = FitOn(s_.model, now_, ranking_[k].fit.hypothesis, s_.effective_sample_size);
      if (!fit.converged) continue;
      ranking_[k].fit = std::move(fit);
      Note(ranking_[k]);
    }
  }

  /// Values and score of the fit of a ranked effect.
  void Note(RankedEffect& r) const {
    r.effect = FittedEffect(r.fit, r.fit.hypothesis.rig.effects.size() - 1);
    r.score = Score(s_.model, r.fit, s_.effective_sample_size);
  }

  const RoundSetting& s_;
  const FitResult& now_;
  FitResult nominal_;  // the rig file's own parameters, where these were screened too
  int round_;
  const double here_ = Score(s_.model, now_, s_.effective_sample_size);
  const double motion_ = WorstMotionRatio(s_.model, now_.residual);
  // without records of a free rotor over time the other kinds of record decide
  const bool shows_motion_ = motion_ == 0 || motion_ > kResonanceShows;
  EffectRound out_;
  std::vector<RankedEffect>& ranking_ = out_.ranking;
};

}  // namespace

EffectRound RankEffects(const RoundSetting& setting, const FitResult& now, int round) {
  return Ranker(setting, now, round).Run();
}

}  // namespace ambrig
