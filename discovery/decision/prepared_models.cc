#include "discovery/decision/prepared_models.h"

#include <algorithm>

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

void UseNuisancesInBoth(CaseModel& full, CaseModel& thin, const std::vector<NuisanceKind>& kinds,
                        double independent) {
  full.nuisances.Use(full, kinds, independent / static_cast<double>(full.size()));
  thin.nuisances.Use(thin, Thinned(kinds, full, thin),
                     independent / static_cast<double>(thin.size()));
}

std::vector<BranchSpan> UseBranchesInBoth(CaseModel& full, CaseModel& thin,
                                          const Hypothesis& nominal) {
  std::vector<BranchSpan> spans = FindBranches(thin, nominal);
  full.branches = RowsIn(full, spans);
  thin.branches = RowsIn(thin, spans);
  return spans;
}

Comparison PrepareModels(CaseModel& full, CaseModel& thin, const Hypothesis& nominal) {
  Comparison before = Compare(full, nominal, false);
  thin.noise_model = full.noise_model;
  thin.LimitAs(full);
  PassFloorsOn(full, thin);
  UseBranchesInBoth(full, thin, nominal);
  if (!full.data().nuisances.any()) return before;
  UseNuisancesInBoth(full, thin, NuisanceKindsOf(full, nominal, before.predicted, true),
                     before.effective_sample_size);
  return before;
}

}  // namespace ambrig
