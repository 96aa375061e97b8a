// Steps of the search: what differs from record to record without being physics that the model lacks.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "discovery/data/input_size.h"
#include "discovery/decision/conclusion.h"
#include "discovery/decision/explainer.h"
#include "discovery/decision/likelihood.h"
#include "discovery/decision/nuisance_choice.h"
#include "discovery/model/residual.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/linear_step.h"

namespace ambrig {

namespace {

// By which a clock may be off [rows], [s]: whichever is more. A larger shift is a matter of the data gate.
constexpr long kMostRows = 4;
constexpr double kMostLate = 5e-4;
// Of what the nuisances explain, for one effect in their place: its law may have another form. Of fewer amounts that much
// may follow a law by chance (eight: F = 63 on 1 and 7 degrees of freedom, p = 1e-4).
constexpr double kMostOfNuisances = 0.9;
constexpr std::size_t kManyAmounts = 8;
constexpr std::size_t kTried = 3;  // effects in their place

}  // namespace

/// Those of these kinds, of all rows, that the errors of the thinned model ask for: errors of coils are taken off there.
std::vector<NuisanceKind> Explainer::ChooseFrom(const std::vector<NuisanceKind>& kinds,
                                                const FitResult& now) const {
  std::vector<NuisanceKind> chosen;
  for (const NuisanceKind& few :
       ChooseNuisances(model_, Thinned(kinds, full_, model_), now.residual,
                       RowWeight(model_, 1, out_.effective_sample_size), !out_.adopted.empty()))
    chosen.push_back(*std::ranges::find(kinds, few.name, &NuisanceKind::name));
  return chosen;
}

/// Zeros, clocks and inputs that differ from record to record, where the case declares none. They are kept where they
/// explain this share of the error above the noise, and a linear step promises a good part of it.
std::optional<Explainer::BeforeNuisances> Explainer::TryNuisances(FitResult& now,
                                                                  double least_share) {
  const StageRatios before = RatiosOf(model_, now);
  if (full_.data().nuisances.any() || full_.nuisances.differ() || before.Answered() < 1.1)
    return {};
  Progress(0.05, "what may differ from record to record");
  const FitResult all = AllRows(now);
  if (all.predicted.empty()) return {};
  const std::vector<NuisanceKind> chosen =
      ChooseFrom(NuisanceKindsOf(full_, now.hypothesis, all.predicted, false), now);
  if (chosen.empty()) return {};
  BeforeNuisances state = {Used(), bank_, {}};
  SetNuisances(chosen);
  const auto give_up = [&]() -> std::optional<BeforeNuisances> {
    UseAgain(state.used);
    bank_ = std::move(state.bank);
    return {};
  };
  const auto explains = [&](const FitResult& after, double least) {
    return ExplainedShare(before.Answered(), RatiosOf(model_, after).Answered()) >= least;
  };
  // what a linear step promises says whether a fit is worth it
  const FitResult promised = LinearlyRefitted(model_, now, out_.effective_sample_size);
  if (!explains(promised, 0.6 * least_share)) return give_up();
  FitResult with = FitNow(now.hypothesis, &promised.jacobian);
  if (!explains(with, least_share)) return give_up();
  state.fit = std::exchange(now, std::move(with));
  out_.ladder.push_back(
      {"zeros, clocks and inputs of each record", now.ratio_fit, now.ratio_validate});
  return state;
}

/// Whether one effect explains as much as the nuisances of every record together, which are many:
/// they are then given up, and the search for effects starts from `bare`.
bool Explainer::OneEffectInstead(const FitResult& bare, const FitResult& with_nuisances) {
  const bool many = full_.nuisances.count() >= kManyAmounts;
  const UsedNuisances used = Used();
  SetNuisances({});
  const double before = RatiosOf(model_, bare).Answered(),
               reached = RatiosOf(model_, with_nuisances).Answered(),
               of_nuisances = ExplainedShare(before, reached);
  const auto explains_as_much = [&](const FitResult& fit) {
    const double after = RatiosOf(model_, fit).Answered();
    return fit.converged &&
           (after < std::max(1.1, 1.03 * reached) ||
            (many && ExplainedShare(before, after) > kMostOfNuisances * of_nuisances));
  };
  ScreenOptions screen;
  screen.effective_sample_size = out_.effective_sample_size;
  const std::vector<Candidate> candidates = Screen(model_, bare, ResidualPeaks(), screen, bank_);
  std::set<std::string> tried;  // each law where it promises most
  for (const Candidate& c : candidates) {
    if (tried.size() == kTried || ExplainedShare(bare.ratio_fit, c.ratio_fit) < 0.6) break;
    if (!tried.insert(c.effect.name).second) continue;
    Progress(0.07, Named(c.effect) + " in place of the nuisances");
    if (!explains_as_much(FitBriefly(model_, bare, c, out_.effective_sample_size))) continue;
    out_.ladder.pop_back();
    effect_instead_ = true;
    return true;
  }
  UseAgain(used);
  bank_.TakeOffNuisances(model_);
  return false;
}

/// Of several effects those go without which the fit beside the nuisances is as good. An effect whose channels the
/// nuisances explain a part of gains less than it did, and stays.
bool Explainer::DropNeedless(const FitResult& base, FitResult& now) {
  constexpr double kAsGood = 20;  // of the score
  const std::size_t before = out_.adopted.size();
  for (std::size_t drop = 0; drop < out_.adopted.size() && out_.adopted.size() > 1;) {
    std::optional<FitResult> without = FitWithout(base, now, drop);
    if (!without || !without->converged || Gain(*without, now) > kAsGood)
      ++drop;
    else
      TakeOut(drop, std::move(*without), now);
  }
  return out_.adopted.size() < before;
}

/// What was found before the nuisances were may be needless beside them, and have another name.
void Explainer::SettleBesideNuisances(const FitResult& base, FitResult& now, bool found_before) {
  if (found_before && DropNeedless(base, now)) AdoptMore(now);
  if (found_before) RejudgeNames(base, now, Names::kAllAnew);
  Polish(now);
  DropSizeless(base, now);
}

/// Beside the effects that were found: nuisances, and the effects that are seen once these are taken off. What explains little
/// stays only if a further effect is then worth adopting: either may hide the other. True when the search
/// is to start again with clocks set right.
bool Explainer::FindWhatDiffers(FitResult& base, FitResult& now) {
  constexpr double kPlain = 0.3, kLittle = 0.05;  // share of the error above the noise
  const std::size_t effects = out_.adopted.size(), rounds = rounds_.size();
  std::optional<BeforeNuisances> before = TryNuisances(now, effects > 0 ? kLittle : kPlain);
  if (!before) return false;
  const bool plain = ExplainedShare(RatiosOf(model_, before->fit).Answered(),
                                    RatiosOf(model_, now).Answered()) >= kPlain;
  if (plain && ((options_.clocks && FindLateRows(now)) || FindInputs(now))) return true;
  const FitResult bare = base;
  if (!effect_instead_ || out_.adopted.empty()) base = FitNow(base.hypothesis, nullptr);
  std::vector<RankedEffect> second = out_.second_round;
  AdoptMore(now);
  if (plain || out_.adopted.size() > effects) {
    if (!plain && options_.clocks && FindLateRows(now)) return true;
    SettleBesideNuisances(base, now, effects > 0);
    return false;
  }
  UseAgain(before->used);
  bank_ = std::move(before->bank);
  now = std::move(before->fit);
  base = bare;
  out_.second_round = std::move(second);
  out_.ladder.pop_back();
  rounds_.resize(rounds);
  return false;
}

/// Nuisances that the case does not declare go again when the effects found explain as much without.
void Explainer::DropNuisances(FitResult& base, FitResult& now) {
  if (full_.data().nuisances.any() || !full_.nuisances.differ() || out_.adopted.empty()) return;
  Progress(0.93, "without zeros, clocks and inputs of each record");
  const UsedNuisances used = Used();
  const SignatureBank bank = bank_;
  const double with = RatiosOf(model_, now).Answered();
  SetNuisances({});
  FitResult without = FitNow(now.hypothesis, nullptr);
  if (without.converged && RatiosOf(model_, without).Answered() < std::max(1.05, 1.03 * with)) {
    now = std::move(without);
    base = FitNow(base.hypothesis, nullptr);
    out_.ladder.push_back({"without differing zeros", now.ratio_fit, now.ratio_validate});
    return;
  }
  UseAgain(used);
  bank_ = bank;
}

/// The amounts of the nuisances at the end.
void Explainer::ReportNuisances(const FitResult& now) {
  if (!model_.nuisances.any()) return;
  out_.nuisances = AmountsOfNuisances(model_, now.predicted);
  StateSdOfCoilErrors(now);
}

/// Records whose clock the nuisances find a row or more off, while others' is right: a delay of the
/// rig would be the same in all.
bool Explainer::FindLateRows(const FitResult& base) {
  if (!full_.nuisances.differ()) return false;
  const std::vector<NuisanceFound> found = AmountsOfNuisances(model_, base.predicted);
  std::vector<int> rows(full_.data().records.size(), 0);
  bool some = false, all = true;
  for (const NuisanceFound& f : found) {
    if (f.name != kTimeShift) continue;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const CaseRecord& record = full_.data().records[r];
      if (record.data_file != f.record) continue;
      const long late = std::lround(f.value * record.data.rate);
      const long most = std::max(kMostRows, std::lround(kMostLate * record.data.rate));
      rows[r] = std::abs(late) <= most ? static_cast<int>(late) : 0;
      some = some || rows[r] != 0;
      all = all && rows[r] == rows[0];
    }
  }
  if (!some || all) return false;
  set_right_.rows_late = std::move(rows);
  return true;
}

/// Pulses that an amplifier's voltage limits, or that move the instants at which its limiter lets go, do not grow in
/// proportion to their set-points: a column of one slope leaves floors of error there. They stay free about the sizes
/// found where the case declares them uncertain, or where they still differ.
bool Explainer::FindInputs(const FitResult& base) {
  constexpr double kKnown = 0.1;     // of the prior's sd: the records tell the size, not the prior
  constexpr double kLeastGain = 10;  // of the score
  const auto kind = std::ranges::find(record_kinds_, std::string(kInputGain), &NuisanceKind::name);
  if (options_.inputs <= 0 || kind == record_kinds_.end()) return false;
  const std::vector<CaseRecord>& records = full_.data().records;
  std::vector<double> larger(records.size(), 0);
  for (const NuisanceFound& f : AmountsOfNuisances(model_, base.predicted))
    for (std::size_t r = 0; r < records.size(); ++r)
      if (f.name == kInputGain && f.record == records[r].data_file && f.sd < kKnown * kind->sd)
        larger[r] = f.value;
  const Case changed = WithInputs(full_.data(), larger);
  CaseModel trial(changed);
  trial.stop = options_.stop;
  trial.LimitAs(full_);
  const auto predicted = trial.Predict(base.hypothesis);
  full_.runs += trial.runs;
  if (!predicted) return false;
  FitResult by_slope = AllRows(base), simulated = by_slope;
  if (!by_slope.Stands()) return false;
  simulated.residual = Residual(full_, *predicted);
  simulated.ratio_fit = Ratio(full_, simulated.residual, Which::kFit);
  simulated.ratio_validate = Ratio(full_, simulated.residual, Which::kValidate);
  if (Gain(by_slope, simulated) < kLeastGain) return false;
  set_right_.inputs_larger = std::move(larger);
  return true;
}

}  // namespace ambrig
