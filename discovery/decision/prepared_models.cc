#include "discovery/decision/prepared_models.h"

#include <algorithm>

#include "discovery/decision/coil_choice.h"
#include "discovery/model/coil_errors.h"
#include "discovery/model/nuisance_kinds.h"
#include "discovery/search/likelihood.h"
#include "simulation/sampled/coil_spread.h"

namespace ambrig {

std::size_t ThinningTo(const Case& c, std::size_t rows) {
  std::size_t all = 0;
  for (const CaseRecord& r : c.records)
    for (const Channel& channel : r.data.channels) all += channel.samples.size();
  return std::clamp<std::size_t>(all / rows, 1, 12);
}

void PassFloorsOn(const CaseModel& full, CaseModel& thin) {
  for (std::size_t t = 0; t < full.targets().size(); ++t)
    thin.targets()[t].floor = full.targets()[t].floor;
}

void UseNuisancesInBoth(CaseModel& full, CaseModel& thin,
                        const std::vector<NuisanceKind>& of_records,
                        const std::vector<NuisanceKind>& of_coils, double independent,
                        double doubt) {
  full.nuisances.Use(full, of_records, RowWeight(full, 1, independent));
  std::vector<NuisanceKind> kinds = Thinned(of_records, full, thin);
  kinds.insert(kinds.end(), of_coils.begin(), of_coils.end());
  const double weight = RowWeight(thin, 1, independent);
  thin.nuisances.Use(thin, kinds, weight, weight / doubt);
}

std::vector<BranchSpan> UseBranchesInBoth(CaseModel& full, CaseModel& thin,
                                          const Hypothesis& nominal) {
  std::vector<BranchSpan> spans = FindBranches(thin, nominal);
  full.branches = RowsIn(full, spans);
  thin.branches = RowsIn(thin, spans);
  return spans;
}

bool RenewCoilErrors(CaseModel& thin, const Hypothesis& at, double independent) {
  if (!CoilsDiffer(at.rig.amplifier)) return false;
  std::vector<NuisanceKind> kinds = thin.nuisances.kinds();
  std::erase_if(kinds, [](const NuisanceKind& kind) { return !kind.coil.empty(); });
  const double weight = RowWeight(thin, 1, independent);
  thin.nuisances.Use(thin, kinds, weight);
  const std::vector<NuisanceKind> possible = CoilErrorKinds(thin, at);
  if (possible.empty()) return false;
  FitOptions here;
  here.iterations = 0;
  here.effective_sample_size = independent;
  const CoilErrorChoice choice = ChooseCoilErrors(thin, possible, Fit(thin, at, here), independent);
  kinds.insert(kinds.end(), choice.kinds.begin(), choice.kinds.end());
  thin.nuisances.Use(thin, kinds, weight, weight / choice.doubt);
  return choice.doubt == 1;
}

Comparison PrepareModels(CaseModel& full, CaseModel& thin, const Hypothesis& nominal) {
  Comparison before = Compare(full, nominal, false);
  thin.noise_model = full.noise_model;
  thin.LimitAs(full);
  thin.LeaveOut(before.unpredictable);
  PassFloorsOn(full, thin);
  UseBranchesInBoth(full, thin, nominal);
  if (full.data().nuisances.any())
    UseNuisancesInBoth(full, thin, NuisanceKindsOf(full, nominal, before.predicted, true), {},
                       before.effective_sample_size, 1);
  RenewCoilErrors(thin, nominal, before.effective_sample_size);
  return before;
}

}  // namespace ambrig
