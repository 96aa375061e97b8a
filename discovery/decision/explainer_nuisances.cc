// Steps of the search: what differs from record to record without being physics that the model lacks.
#include <algorithm>
#include <cmath>

#include "discovery/decision/conclusion.h"
#include "discovery/decision/explainer.h"
#include "discovery/decision/likelihood.h"
#include "discovery/decision/nuisance_choice.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/linear_step.h"

namespace ambrig {

namespace {

constexpr long kMostRows = 4;  // by which a clock may be off; more is a matter of the data gate

}  // namespace

/// Zeros, clocks and inputs that differ from record to record, where the case declares none.
/// `alone`: before any effect is sought, when they explain half of what is left.
bool Explainer::TryNuisances(FitResult& now, bool alone) {
  const StageRatios before = RatiosOf(model_, now);
  if (full_.data().nuisances.any() || full_.nuisances.any() || before.Answered() < 1.1)
    return false;
  Progress(0.05, "what may differ from record to record");
  const FitResult all = AllRows(now);
  if (all.predicted.empty()) return false;
  const double weight = RowWeight(full_, 1, out_.effective_sample_size);
  const std::vector<NuisanceKind> chosen = ChooseNuisances(
      full_, NuisanceKindsOf(full_, now.hypothesis, all.predicted, false), all.residual, weight);
  if (chosen.empty()) return false;
  const SignatureBank bank = bank_;
  SetNuisances(chosen);
  const auto give_up = [&] {
    full_.nuisances = model_.nuisances = Nuisances();
    bank_ = bank;
    return false;
  };
  const auto explains = [&](const StageRatios& after, double least) {
    return ExplainedShare(before.Answered(), after.Answered()) >= least;
  };
  // what a linear step promises says whether a fit is worth it
  const FitResult promised = LinearlyRefitted(model_, now, out_.effective_sample_size);
  if (!explains(RatiosOf(model_, promised), alone ? 0.3 : 0.2)) return give_up();
  FitResult with = FitNow(now.hypothesis, &promised.jacobian);
  if (!explains(RatiosOf(model_, with), alone ? 0.5 : 0.3)) return give_up();
  now = std::move(with);
  out_.ladder.push_back(
      {"zeros, clocks and inputs of each record", now.ratio_fit, now.ratio_validate});
  return true;
}

/// Whether one effect explains as much as the nuisances of every record together, which are many:
/// they are then given up, and the search for effects starts from `bare`.
bool Explainer::OneEffectInstead(const FitResult& bare, const FitResult& with_nuisances) {
  const Nuisances full = full_.nuisances, thinned = model_.nuisances;
  full_.nuisances = model_.nuisances = Nuisances();
  bank_ = SignatureBank();
  const double reached = RatiosOf(model_, with_nuisances).Answered();
  ScreenOptions screen;
  screen.effective_sample_size = out_.effective_sample_size;
  const std::vector<Candidate> candidates = Screen(model_, bare, ResidualPeaks(), screen, bank_);
  const std::size_t tried = std::min<std::size_t>(candidates.size(), 3);
  for (std::size_t k = 0; k < tried; ++k) {
    if (ExplainedShare(bare.ratio_fit, candidates[k].ratio_fit) < 0.6) break;
    Progress(0.07, Named(candidates[k].effect) + " in place of the nuisances");
    const FitResult fit = FitBriefly(model_, bare, candidates[k], out_.effective_sample_size);
    if (!fit.converged || RatiosOf(model_, fit).Answered() > std::max(1.1, 1.03 * reached))
      continue;
    out_.ladder.pop_back();
    return true;
  }
  full_.nuisances = full;
  model_.nuisances = thinned;
  bank_.TakeOffNuisances(model_);
  return false;
}

/// Nuisances that the case does not declare go again when the effects found explain as much without.
void Explainer::DropNuisances(FitResult& base, FitResult& now) {
  if (full_.data().nuisances.any() || !full_.nuisances.any() || out_.adopted.empty()) return;
  Progress(0.93, "without zeros, clocks and inputs of each record");
  const Nuisances full = full_.nuisances, thinned = model_.nuisances;
  const SignatureBank bank = bank_;
  const double with = RatiosOf(model_, now).Answered();
  full_.nuisances = model_.nuisances = Nuisances();
  FitResult without = FitNow(now.hypothesis, nullptr);
  if (without.converged && RatiosOf(model_, without).Answered() < std::max(1.05, 1.03 * with)) {
    now = std::move(without);
    base = FitNow(base.hypothesis, nullptr);
    bank_ = SignatureBank();
    out_.ladder.push_back({"without differing zeros", now.ratio_fit, now.ratio_validate});
    return;
  }
  full_.nuisances = full;
  model_.nuisances = thinned;
  bank_ = bank;
}

/// The amounts of the nuisances at the end.
void Explainer::ReportNuisances(const FitResult& now) {
  if (!full_.nuisances.any()) return;
  const Nuisances used = full_.nuisances;
  full_.nuisances = Nuisances();
  out_.nuisances = used.Amounts(full_, AllRows(now).residual);
  full_.nuisances = used;
}

/// Records whose clock the nuisances find a row or more off, while others' is right: a delay of the
/// rig would be the same in all.
bool Explainer::FindLateRows(const FitResult& base) {
  if (!full_.nuisances.any()) return false;
  const Nuisances used = full_.nuisances;
  full_.nuisances = Nuisances();
  const std::vector<NuisanceFound> found = used.Amounts(full_, AllRows(base).residual);
  full_.nuisances = used;
  std::vector<int> rows(full_.data().records.size(), 0);
  bool some = false, all = true;
  for (const NuisanceFound& f : found) {
    if (f.name != kTimeShift) continue;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const CaseRecord& record = full_.data().records[r];
      if (record.data_file != f.record) continue;
      const long late = std::lround(f.value * record.data.rate);
      rows[r] = std::abs(late) <= kMostRows ? static_cast<int>(late) : 0;
      some = some || rows[r] != 0;
      all = all && rows[r] == rows[0];
    }
  }
  if (!some || all) return false;
  rows_late_ = std::move(rows);
  return true;
}

}  // namespace ambrig
