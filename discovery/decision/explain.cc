#include "discovery/decision/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "discovery/decision/decide.h"
#include "discovery/decision/describe.h"
#include "discovery/decision/likelihood.h"
#include "discovery/search/candidate_fit.h"

namespace ambrig {

namespace {

/// Rows that the search looks at: more would cost time and tell nothing new.
constexpr std::size_t kRows = 150000;

std::size_t Thinning(const Case& c) {
  std::size_t rows = 0;
  for (const CaseRecord& r : c.records)
    for (const Channel& channel : r.data.channels) rows += channel.samples.size();
  return std::clamp<std::size_t>(rows / kRows, 1, 12);
}

class Explainer {
 public:
  Explainer(const Case& c, const ExplainOptions& options)
      : options_(options), full_(c), model_(c, Thinning(c)), rig_(c.rig) {
    full_.stop = model_.stop = options.stop;
    full_.store = model_.store = options.store;
  }

  Explanation Run() {
    const auto begin = std::chrono::steady_clock::now();
    Progress(0.0, "noise floor");
    const Hypothesis nominal = Hypothesis::Base(rig_);
    const NoiseFloor floor = FindFloor(full_, nominal);
    for (std::size_t t = 0; t < full_.targets().size(); ++t)
      model_.targets()[t].floor = full_.targets()[t].floor;
    out_.effective_sample_size = floor.effective_sample_size;
    const FitResult as_filed = At(nominal);
    const std::vector<double>& r0 = as_filed.residual;
    out_.nominal_ratio_validate = Validated(r0);
    out_.ladder.push_back({"", Ratio(model_, r0, Which::kFit), out_.nominal_ratio_validate});
    Progress(0.03, "rig parameters");
    FitResult base = FitNow(nominal, &as_filed.jacobian);
    if (base.ratio_validate > out_.nominal_ratio_validate &&
        base.ratio_fit > 0.999 * out_.ladder[0].ratio_fit)
      base = as_filed;
    out_.base_ratio_fit = base.ratio_fit;
    out_.base_ratio_validate = base.ratio_validate;
    out_.ladder.push_back({"parameters", base.ratio_fit, base.ratio_validate});
    NoteShifts(base);
    FitResult now = base;
    for (int round = 0; round < options_.rounds; ++round)
      if (!AdoptBest(now, round)) break;
    TryPairs(base, now);
    if (RenewFloor(as_filed, base, now))
      for (int round = static_cast<int>(out_.adopted.size()); round < options_.rounds; ++round)
        if (!AdoptBest(now, round)) break;
    Backward(base, now);
    Polish(now);
    out_.final_fit = now;
    out_.final_ratio_fit = now.ratio_fit;
    out_.final_ratio_validate = now.ratio_validate;
    out_.verdict = VerdictOf(out_.nominal_ratio_validate, out_.base_ratio_validate,
                             now.ratio_validate, !out_.adopted.empty());
    out_.warnings = now.warnings;
    if (floor_renewed_)
      out_.warnings.push_back(
          "the loop of the model found passes more noise than the rig file's: the noise floor is "
          "the found model's");
    if (out_.verdict == "unknown") out_.unexplained = Describe(full_, AllRows(now));
    if (out_.verdict != "effect") out_.adopted.clear();
    FindConfusable();
    out_.runs = full_.runs + model_.runs;
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

  FitOptions Options(const Eigen::MatrixXd* jacobian) const {
    FitOptions o;
    o.effective_sample_size = out_.effective_sample_size;
    o.base_jacobian = jacobian;
    return o;
  }
  FitResult FitNow(const Hypothesis& start, const Eigen::MatrixXd* jacobian) const {
    return Fit(model_, start, Options(jacobian));
  }

  /// The point itself, with its sensitivities.
  FitResult At(const Hypothesis& h) const {
    FitOptions o = Options(nullptr);
    o.iterations = 0;
    return Fit(model_, h, o);
  }

  bool Finished(const FitResult& now) const {
    // Nothing that an effect could still win (see WorthAdopting), with parameters that can be
    // believed.
    return Believable(now) && now.ratio_validate * now.ratio_validate < 1.025 &&
           now.ratio_fit * now.ratio_fit < 1.04;
  }

  double ScoreOf(const FitResult& fit) const {
    return Score(model_, fit, out_.effective_sample_size);
  }
  double Gain(const FitResult& before, const FitResult& after) const {
    return ScoreOf(before) - ScoreOf(after);
  }

  /// Adds the effect that explains most of what is left; false: nothing left, or none worth it.
  bool AdoptBest(FitResult& now, int round) {
    if (Finished(now)) return false;
    const double from = 0.08 + 0.3 * round;
    EffectRound ranked =
        RankEffects({full_, model_, bank_, out_.effective_sample_size, options_.candidates,
                     [&](double f, const std::string& text) { Progress(from + 0.3 * f, text); }},
                    now, round);
    const std::vector<RankedEffect>& ranking = ranked.ranking;
    if (round == 0) out_.screened = std::move(ranked.screened);
    (round == 0 ? out_.ranking : out_.second_round) = ranking;
    if (ranking.empty() ||
        !WorthAdopting(now, ranking[0].fit, Gain(now, ranking[0].fit), round, first_fall_))
      return false;
    if (round == 0)
      first_fall_ = now.ratio_validate * now.ratio_validate -
                    ranking[0].fit.ratio_validate * ranking[0].fit.ratio_validate;
    now = ranking[0].fit;
    out_.adopted.push_back(ranking[0].effect);
    out_.ladder.push_back({Named(ranking[0].effect), now.ratio_fit, now.ratio_validate});
    if (options_.checkpoint) options_.checkpoint(out_);
    return true;
  }

  /// A rig whose loop is nearly unstable with the hidden effect passes more noise than the rig
  /// file's: what seems unexplained may be noise of the model found. True when the floor was
  /// renewed.
  bool RenewFloor(const FitResult& as_filed, FitResult& base, FitResult& now) {
    if (out_.adopted.empty() || VerdictOf(out_.nominal_ratio_validate, out_.base_ratio_validate,
                                          now.ratio_validate, true) == "effect")
      return false;
    Progress(0.86, "noise floor of the model found");
    const std::vector<Target> before = full_.targets();
    try {
      out_.effective_sample_size = FindFloor(full_, now.hypothesis).effective_sample_size;
    } catch (const InputError&) {
      return false;  // with noise it does not hold its rotor
    }
    const double old = now.ratio_validate;
    for (std::size_t t = 0; t < before.size(); ++t)
      model_.targets()[t].floor = full_.targets()[t].floor =
          std::max(before[t].floor, full_.targets()[t].floor);
    base = At(base.hypothesis);
    now = FitNow(now.hypothesis, nullptr);
    out_.nominal_ratio_validate = At(as_filed.hypothesis).ratio_validate;
    out_.base_ratio_fit = base.ratio_fit;
    out_.base_ratio_validate = base.ratio_validate;
    first_fall_ = std::pow(base.ratio_validate, 2) - std::pow(now.ratio_validate, 2);
    bank_ = SignatureBank();
    if (now.ratio_validate < 0.8 * old) {
      out_.ladder.push_back({"noise floor of this model", now.ratio_fit, now.ratio_validate});
      floor_renewed_ = true;
    }
    return true;
  }

  /// The same point seen with all rows.
  FitResult AllRows(const FitResult& fit) const {
    FitOptions o = Options(nullptr);
    o.iterations = 0;
    o.sensitivities = false;
    return Fit(full_, fit.hypothesis, o);
  }

  /// The effect that explains most alone may be none of two that are there: the best pairs of the
  /// screening are fitted too where one effect does not explain nearly all.
  void TryPairs(const FitResult& base, FitResult& now) {
    if (out_.ranking.empty() || (out_.adopted.size() < 2 && Finished(now))) return;
    Progress(0.8, "pairs of effects");
    for (const CandidatePair& p : ScreenPairs(model_, base, out_.effective_sample_size, bank_, 3)) {
      if (AlreadyTried(p) || p.score > ScoreOf(base)) continue;
      Progress(0.82, "fitting " + Named(p.first) + " with " + Named(p.second));
      Hypothesis h = base.hypothesis;
      h.AddEffect(p.first);
      h.AddEffect(p.second);
      FitResult fit = FitOn(model_, base, h, out_.effective_sample_size);
      const bool more = out_.adopted.size() < 2;
      if (!fit.converged || Gain(now, fit) < (more ? 20 : 0) ||
          (more && !WorthAdopting(now, fit, Gain(now, fit), 1, first_fall_)))
        continue;
      now = std::move(fit);
      out_.adopted = {FittedEffect(now, rig_.effects.size()),
                      FittedEffect(now, rig_.effects.size() + 1)};
      out_.ladder.resize(2);
      out_.ladder.push_back(
          {Named(p.first) + " and " + Named(p.second), now.ratio_fit, now.ratio_validate});
    }
  }

  /// The steps one by one have fitted this pair, or one with more in it.
  bool AlreadyTried(const CandidatePair& p) const {
    int found = 0;
    for (const EffectInstance& e : out_.adopted)
      for (const EffectInstance* o : {&p.first, &p.second})
        found += e.name == o->name && e.target == o->target ? 1 : 0;
    return found == 2 || (found == 1 && out_.adopted.size() == 1);
  }

  /// An effect that its successors made needless goes again.
  void Backward(const FitResult& base, FitResult& now) {
    if (out_.adopted.size() < 2) return;
    for (std::size_t drop = 0; drop < out_.adopted.size() && out_.adopted.size() > 1;) {
      Hypothesis h = base.hypothesis;
      for (std::size_t k = 0; k < out_.adopted.size(); ++k)
        if (k != drop) h.AddEffect(out_.adopted[k]);
      Progress(0.9, "without " + out_.adopted[drop].name);
      FitResult without = FitOn(model_, base, h, out_.effective_sample_size);
      if (WorthAdopting(without, now, Gain(without, now), 1, 0)) {
        ++drop;
        continue;
      }
      out_.adopted.erase(out_.adopted.begin() + static_cast<std::ptrdiff_t>(drop));
      now = std::move(without);
      out_.ladder.push_back(
          {"without the effect that became needless", now.ratio_fit, now.ratio_validate});
    }
  }

  /// A last fit with fresh sensitivities of everything.
  void Polish(FitResult& now) {
    if (out_.adopted.empty()) return;
    Progress(0.94, "final fit");
    FitResult polished = FitNow(now.hypothesis, nullptr);
    if (polished.ratio_fit <= now.ratio_fit * 1.0005) now = std::move(polished);
    for (std::size_t k = 0; k < out_.adopted.size(); ++k)
      out_.adopted[k] = FittedEffect(now, rig_.effects.size() + k);
    out_.ladder.back().ratio_fit = now.ratio_fit;
    out_.ladder.back().ratio_validate = now.ratio_validate;
  }

  void NoteShifts(const FitResult& base) {
    for (std::size_t k = 0; k < base.hypothesis.free.size(); ++k) {
      const double sds = base.hypothesis.Coordinate(k);
      if (std::abs(sds) > 1)
        out_.parameter_shifts.push_back(
            fmt::format("{} {:+.2f} sd", base.hypothesis.free[k].path, sds));
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
      out_.confusable.push_back(
          {best.effect.name, other.effect.name,
           SeparatingRecord(model_, best.fit.hypothesis, other.fit.hypothesis)});
    }
  }

  ExplainOptions options_;
  CaseModel full_, model_;  // with all rows: floor and frequencies; with some: the search
  RigParameters rig_;
  Explanation out_;
  SignatureBank bank_;
  bool floor_renewed_ = false;
  double first_fall_ = 0;  // of the squared ratio on unseen records, by the first effect
};

}  // namespace

Explanation Explain(const Case& c, const ExplainOptions& options) {
  return Explainer(c, options).Run();
}

}  // namespace ambrig
