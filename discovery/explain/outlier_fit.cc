#include "discovery/explain/outlier_fit.h"

#include <algorithm>
#include <cmath>

#include "discovery/search/burst_rows.h"
#include "discovery/search/posterior_draws.h"

namespace ambrig {

namespace {

constexpr int kBranchDraws = 31;

/// Residuals of hypotheses that the records allow as well as `fit`, itself the first, in the
/// records of the bursts.
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
  RecordSubset look{std::vector<char>(model.data().records.size(), 0), fit.predicted};
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

void FitPastOutliers(SearchModels& models, FitResult& now) {
  constexpr double kLeastGain = 10;  // of the score
  const CaseModel& model = models.thinned();
  const std::vector<SampleSpan> bursts = BurstRows(model, now.residual, Which::kFit);
  if (bursts.empty()) return;
  const FitResult without = models.FitWithoutRows(bursts, now.hypothesis);
  if (!without.converged) return;
  const Branches branches = BranchesOf(model, without, bursts, models.effective_sample_size());
  if (branches.hypotheses.empty()) return;
  const FitResult there = models.At(BestBranchOf(model, branches));
  FitResult again = models.FitFrom(there.hypothesis, &there.jacobian);
  if (!again.converged || models.ScoreOf(there) < models.ScoreOf(again)) again = there;
  if (again.converged && models.Gain(now, again) > kLeastGain) now = std::move(again);
}

bool PassOverOutliers(SearchModels& models, NuisanceSelection& nuisances, FitResult& now) {
  constexpr double kGone = 0.3;  // of the burst's rms
  const CaseModel& model = models.thinned();
  const std::vector<SampleSpan> bursts = BurstRows(model, now.residual, Which::kValidate);
  if (bursts.empty()) return false;
  const Branches branches = BranchesOf(model, now, bursts, models.effective_sample_size());
  std::vector<SampleSpan> open;
  for (const SampleSpan& s : bursts) {
    const double here = WorstRmsIn(model, now.residual, s);
    if (std::ranges::any_of(branches.residuals, [&](const std::vector<double>& r) {
          return WorstRmsIn(model, r, s) < std::max(kGone * here, 1.5);
        }))
      open.push_back(s);
  }
  if (open.empty()) return false;
  models.LeaveOut(open);
  nuisances.UseOfRecords(nuisances.of_records());
  now = models.At(now.hypothesis);
  return true;
}

}  // namespace ambrig
