// Rows where model and machine took different branches, for example because a limiter held one period longer.
#include <algorithm>
#include <cmath>

#include "discovery/explain/explanation_search.h"
#include "discovery/model/residual.h"
#include "discovery/search/burst_rows.h"
#include "discovery/search/posterior_draws.h"

namespace ambrig {

namespace {

constexpr int kBranchDraws = 31;

/// Residuals of hypotheses that the records allow as well as `fit`, itself the first, in the records of the bursts.
struct Branches {
  std::vector<Hypothesis> hypotheses;
  std::vector<std::vector<double>> residuals;
};

Branches BranchesOf(const CaseModel& model, const FitResult& fit,
                    const std::vector<SampleSpan>& bursts, double effective_sample_size) {
  Branches out;
  std::vector<Hypothesis> all = {fit.hypothesis};
  for (Hypothesis& h : PosteriorDraws(model, fit, effective_sample_size, kBranchDraws))
    all.push_back(std::move(h));
  QuickLook look{std::vector<char>(model.data().records.size(), 0), fit.predicted};
  for (const SampleSpan& s : bursts) look.records[s.record] = 1;
  auto predicted = model.PredictAll(all, ModelFidelity::kAsSampled, &look);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!predicted[k]) continue;
    out.residuals.push_back(Residual(model, *predicted[k]));
    out.hypotheses.push_back(std::move(all[k]));
  }
  return out;
}

/// The one that leaves the least error in the fitted records.
const Hypothesis& BestBranchOf(const CaseModel& model, const Branches& branches) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < branches.residuals.size(); ++k)
    if (Ratio(model, branches.residuals[k], Which::kFit) <
        Ratio(model, branches.residuals[best], Which::kFit))
      best = k;
  return branches.hypotheses[best];
}

/// rms of the worst channel over the rows of a span [floors].
double WorstRmsIn(const CaseModel& model, const std::vector<double>& residual,
                  const SampleSpan& span) {
  double worst = 0;
  for (const Target& t : model.targets()) {
    if (t.record != span.record) continue;
    double square = 0, n = 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      if (model.ok()[k] && span.first <= model.sample(k) && model.sample(k) <= span.last)
        square += residual[k] * residual[k], n += 1;
    if (n > 0) worst = std::max(worst, std::sqrt(square / n));
  }
  return worst;
}

}  // namespace

/// A fit without the rows where errors are large, few and together tells where the parameters may be; of what it
/// allows, the point whose simulation takes the machine's branch most is the start of a fit with all rows.
void Explainer::FitPastBursts(FitResult& now) {
  constexpr double kLeastGain = 10;  // of the score
  const std::vector<SampleSpan> bursts = BurstRows(model_, now.residual, Which::kFit);
  if (bursts.empty()) return;
  const std::vector<char> counted = model_.sound();
  model_.LeaveOut(bursts);
  const FitResult without = FitNow(now.hypothesis, nullptr);
  model_.SetSound(counted);
  if (!without.converged) return;
  const Branches branches = BranchesOf(model_, without, bursts, out_.effective_sample_size);
  if (branches.hypotheses.empty()) return;
  const FitResult there = At(BestBranchOf(model_, branches));
  FitResult again = FitNow(there.hypothesis, &there.jacobian);
  if (!again.converged || ScoreOf(there) < ScoreOf(again)) again = there;
  if (again.converged && Gain(now, again) > kLeastGain) now = std::move(again);
}

/// Nothing is fitted to unseen records: where their bursts are gone for one of the hypotheses that the fitted records
/// allow, these rows tell no law from another and do not count.
bool Explainer::PassOverBursts(FitResult& now) {
  constexpr double kGone = 0.3;  // of the burst's rms
  const std::vector<SampleSpan> bursts = BurstRows(model_, now.residual, Which::kValidate);
  if (bursts.empty()) return false;
  const Branches branches = BranchesOf(model_, now, bursts, out_.effective_sample_size);
  std::vector<SampleSpan> open;
  for (const SampleSpan& s : bursts) {
    const double here = WorstRmsIn(model_, now.residual, s);
    if (std::ranges::any_of(branches.residuals, [&](const std::vector<double>& r) {
          return WorstRmsIn(model_, r, s) < std::max(kGone * here, 1.5);
        }))
      open.push_back(s);
  }
  if (open.empty()) return false;
  full_.LeaveOut(open);
  model_.LeaveOut(open);
  SetNuisances(record_kinds_);
  now = At(now.hypothesis);
  return true;
}

}  // namespace ambrig
