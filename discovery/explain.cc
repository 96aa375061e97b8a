#include "discovery/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "discovery/decide.h"
#include "discovery/describe.h"

namespace ambrig {

namespace {

/// Fitted values and sd of the hypothesis' last effect.
EffectInstance FittedEffect(const FitResult& fit) {
  const int last = static_cast<int>(fit.hypothesis.rig.effects.size()) - 1;
  EffectInstance e = fit.hypothesis.rig.effects.back();
  for (std::size_t k = 0; k < fit.hypothesis.free.size(); ++k) {
    const FreeParameter& p = fit.hypothesis.free[k];
    if (p.effect == last && k < fit.sd.size()) e.sd[p.row] = fit.sd[k];
  }
  return e;
}

class Explainer {
 public:
  Explainer(const Case& c, const ExplainOptions& options) : options_(options), model_(c), rig_(c.rig) { model_.stop = options.stop; }

  Explanation Run() {
    const auto begin = std::chrono::steady_clock::now();
    Progress(0.0, "noise floor");
    const Hypothesis nominal = Hypothesis::Base(rig_);
    const NoiseFloor floor = FindFloor(model_, nominal);
    out_.effective = floor.effective;
    const std::vector<double> r0 = Residual(model_, floor.clean);
    out_.nominal_ratio_validate = Validated(r0);
    out_.ladder.push_back({"", Ratio(model_, r0, Which::kFit), out_.nominal_ratio_validate});
    Progress(0.03, "rig parameters");
    FitResult base = FitNow(nominal, nullptr);
    if (base.ratio_validate > out_.nominal_ratio_validate && base.ratio_fit > 0.999 * out_.ladder[0].ratio_fit) base = KeepNominal(nominal, floor.clean);
    out_.base_ratio_fit = base.ratio_fit;
    out_.base_ratio_validate = base.ratio_validate;
    out_.ladder.push_back({"parameters", base.ratio_fit, base.ratio_validate});
    NoteShifts(base);
    FitResult now = base;
    for (int round = 0; round < options_.rounds; ++round) {
      if (Finished(now)) break;
      std::vector<RankedEffect> ranking = Round(now, round);
      if (round == 0) out_.ranking = ranking;
      else out_.second_round = ranking;
      if (ranking.empty() || !WorthAdopting(now, ranking[0].fit, Gain(now, ranking[0].fit), round, first_fall_)) break;
      if (round == 0) first_fall_ = now.ratio_validate * now.ratio_validate - ranking[0].fit.ratio_validate * ranking[0].fit.ratio_validate;
      now = ranking[0].fit;
      out_.adopted.push_back(ranking[0].effect);
      out_.ladder.push_back({ranking[0].effect.name + " at " + ranking[0].effect.target, now.ratio_fit, now.ratio_validate});
      if (options_.checkpoint) options_.checkpoint(out_);
    }
    Backward(base, now);
    Polish(now);
    out_.final_fit = now;
    out_.final_ratio_fit = now.ratio_fit;
    out_.final_ratio_validate = now.ratio_validate;
    out_.verdict = VerdictOf(out_.nominal_ratio_validate, out_.base_ratio_validate, now.ratio_validate, !out_.adopted.empty());
    out_.warnings = now.warnings;
    if (out_.verdict == "unknown") out_.unexplained = Describe(model_, now);
    if (out_.verdict != "effect") out_.adopted.clear();
    FindConfusable();
    out_.runs = model_.runs;
    out_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    Progress(1.0, "done");
    return std::move(out_);
  }

 private:
  void Progress(double fraction, const std::string& text) const {
    if (options_.stop && options_.stop->load()) throw Interrupted();
    if (options_.progress) options_.progress(fraction, text);
  }

  double Validated(const std::vector<double>& residual) const {
    const double v = Ratio(model_, residual, Which::kValidate);
    return v > 0 ? v : Ratio(model_, residual, Which::kFit);
  }

  FitResult FitNow(const Hypothesis& start, const Eigen::MatrixXd* jacobian) const {
    FitOptions o;
    o.effective = out_.effective;
    o.base_jacobian = jacobian;
    o.iterations = 4;
    return Fit(model_, start, o);
  }

  FitResult KeepNominal(const Hypothesis& nominal, const std::vector<double>& predicted) const {
    FitOptions o;
    o.effective = out_.effective;
    o.iterations = 0;
    FitResult fit = Fit(model_, nominal, o);
    fit.predicted = predicted;
    return fit;
  }

  bool Finished(const FitResult& now) const {
    // Nothing that an effect could still win: see WorthAdopting.
    return now.ratio_validate * now.ratio_validate < 1.015 || (now.ratio_validate < 1.012 && now.ratio_fit < 1.012);
  }

  int Parameters(const FitResult& fit) const {
    int n = 0;
    for (const FreeParameter& p : fit.hypothesis.free) n += p.effect >= 0 ? 1 : 0;
    return n;
  }
  double ScoreOf(const FitResult& fit) const {
    return Score(model_, fit.ratio_fit, fit.ratio_validate, out_.effective, Parameters(fit));
  }
  double Gain(const FitResult& before, const FitResult& after) const { return ScoreOf(before) - ScoreOf(after); }

  std::vector<RankedEffect> Round(const FitResult& now, int round) {
    const double from = 0.08 + 0.3 * round, share = 0.3;
    ScreenOptions screen;
    screen.effective = out_.effective;
    screen.progress = [&](double f, const std::string& text) { Progress(from + 0.6 * share * f, "screening " + text); };
    const std::vector<Candidate> candidates = Screen(model_, now, screen, bank_);
    if (round == 0) out_.screened = candidates;
    std::vector<RankedEffect> ranking;
    const double here = ScoreOf(now);
    for (std::size_t k = 0; k < candidates.size() && static_cast<int>(ranking.size()) < options_.candidates; ++k) {
      const Candidate& c = candidates[k];
      // Hopeless ones need no full fit, but a user wants to see a few beside the best.
      if (c.score > here && (ranking.size() >= 2 || round > 0)) break;
      if (Decided(now, ranking, c) || (round > 0 && !Promising(now, c))) break;
      Progress(from + share * (0.6 + 0.4 * static_cast<double>(k) / options_.candidates), "fitting " + c.effect.name + " at " + c.effect.target);
      Hypothesis h = now.hypothesis;
      h.AddEffect(c.effect);
      RankedEffect r;
      r.fit = FitNow(h, &now.jacobian);
      r.effect = FittedEffect(r.fit);
      r.score = ScoreOf(r.fit);
      r.screened_ratio = c.ratio_validate;
      r.fit.jacobian.resize(0, 0);
      ranking.push_back(std::move(r));
    }
    std::stable_sort(ranking.begin(), ranking.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
    SetProbabilities(ranking);
    if (!ranking.empty()) {  // the winner needs its own sensitivities for the next round
      FitOptions o;
      o.effective = out_.effective;
      o.base_jacobian = &now.jacobian;
      o.iterations = 3;
      ranking[0].fit = Fit(model_, ranking[0].fit.hypothesis, o);
      ranking[0].effect = FittedEffect(ranking[0].fit);
    }
    return ranking;
  }

  /// Whether the linear screening promises at least half of what adoption would ask for.
  static bool Promising(const FitResult& now, const Candidate& c) {
    const double fall = now.ratio_validate * now.ratio_validate - c.ratio_validate * c.ratio_validate;
    return fall > 0.012 && ExplainedShare(now.ratio_validate, c.ratio_validate) > 0.17;
  }

  /// The best fit so far explains nearly all, and this candidate promises far less.
  bool Decided(const FitResult& now, const std::vector<RankedEffect>& ranking, const Candidate& next) const {
    if (ranking.size() < 2) return false;
    double best = kInfinity;
    for (const RankedEffect& r : ranking) best = std::min(best, r.fit.ratio_validate);
    return ExplainedShare(now.ratio_validate, best) > 0.9 && next.ratio_validate * next.ratio_validate - 1 > 4 * (best * best - 1);
  }

  void SetProbabilities(std::vector<RankedEffect>& ranking) const {
    if (ranking.empty()) return;
    // Laws differ from the truth in detail, so the likelihood is trusted as if 300 numbers were seen.
    const double temper = 0.5 * std::min(1.0, 300 / std::max(out_.effective, 1.0));
    double sum = 0;
    for (RankedEffect& r : ranking) sum += r.probability = std::exp(-temper * (r.score - ranking[0].score));
    for (RankedEffect& r : ranking) r.probability /= sum;
  }

  /// An effect that its successors made needless goes again.
  void Backward(const FitResult& base, FitResult& now) {
    if (out_.adopted.size() < 2) return;
    for (std::size_t drop = 0; drop + 1 < out_.adopted.size();) {
      Hypothesis h = base.hypothesis;
      for (std::size_t k = 0; k < out_.adopted.size(); ++k)
        if (k != drop) h.AddEffect(out_.adopted[k]);
      Progress(0.9, "without " + out_.adopted[drop].name);
      FitResult without = FitNow(h, &base.jacobian);
      if (WorthAdopting(without, now, Gain(without, now), 1, 0)) {
        ++drop;
        continue;
      }
      out_.adopted.erase(out_.adopted.begin() + static_cast<std::ptrdiff_t>(drop));
      now = std::move(without);
      out_.ladder.push_back({"without the effect that became needless", now.ratio_fit, now.ratio_validate});
    }
  }

  /// A last fit with fresh sensitivities of everything.
  void Polish(FitResult& now) {
    if (out_.adopted.empty()) return;
    Progress(0.94, "final fit");
    FitOptions o;
    o.effective = out_.effective;
    o.iterations = 4;
    FitResult polished = Fit(model_, now.hypothesis, o);
    if (polished.ratio_fit <= now.ratio_fit * 1.0005) now = std::move(polished);
    for (std::size_t k = 0; k < out_.adopted.size(); ++k) {
      EffectInstance& e = out_.adopted[k];
      e = now.hypothesis.rig.effects[rig_.effects.size() + k];
      for (std::size_t p = 0; p < now.hypothesis.free.size(); ++p)
        if (now.hypothesis.free[p].effect == static_cast<int>(rig_.effects.size() + k)) e.sd[now.hypothesis.free[p].row] = now.sd[p];
    }
    out_.ladder.back().ratio_fit = now.ratio_fit;
    out_.ladder.back().ratio_validate = now.ratio_validate;
  }

  void NoteShifts(const FitResult& base) {
    for (std::size_t k = 0; k < base.hypothesis.free.size(); ++k) {
      const double sds = base.hypothesis.Coordinate(k);
      if (std::abs(sds) > 1) out_.parameter_shifts.push_back(fmt::format("{} {:+.2f} sd", base.hypothesis.free[k].path, sds));
    }
  }

  /// Pairs that these records leave open, and the record that would decide.
  void FindConfusable() {
    if (out_.ranking.size() < 2) return;
    const RankedEffect& best = out_.ranking[0];
    for (std::size_t k = 1; k < out_.ranking.size() && out_.confusable.size() < 2; ++k) {
      const RankedEffect& other = out_.ranking[k];
      if (other.effect.name == best.effect.name || other.probability < 0.02) continue;
      Progress(0.97, "what would tell " + best.effect.name + " from " + other.effect.name);
      out_.confusable.push_back({best.effect.name, other.effect.name, SeparatingRecord(model_, best.fit.hypothesis, other.fit.hypothesis)});
    }
  }

  ExplainOptions options_;
  CaseModel model_;
  RigParameters rig_;
  Explanation out_;
  SignatureBank bank_;
  double first_fall_ = 0;  // of the squared ratio on unseen records, by the first effect
};

}  // namespace

Explanation Explain(const Case& c, const ExplainOptions& options) { return Explainer(c, options).Run(); }

}  // namespace ambrig
