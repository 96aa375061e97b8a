#include "discovery/decision/prepared_models.h"

#include <algorithm>

#include "discovery/decision/coil_choice.h"
#include "discovery/decision/likelihood.h"
#include "discovery/model/coil_errors.h"
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

namespace {

/// What the coils of the machine differ by, beside these nuisances of its records: as Explain takes it off before any
/// effect is sought.
void AddCoilErrors(CaseModel& full, CaseModel& thin, const Hypothesis& nominal,
                   const std::vector<NuisanceKind>& of_records, double independent) {
  if (!CoilsDiffer(nominal.rig.amplifier)) return;
  const std::vector<NuisanceKind> possible = CoilErrorKinds(thin, nominal);
  if (possible.empty()) return;
  FitOptions here;
  here.iterations = 0;
  here.effective_sample_size = independent;
  const CoilErrorChoice choice =
      ChooseCoilErrors(thin, possible, Fit(thin, nominal, here), independent);
  std::vector<NuisanceKind> of_coils;
  for (const std::size_t k : choice.chosen) of_coils.push_back(possible[k]);
  UseNuisancesInBoth(full, thin, of_records, of_coils, independent, choice.doubt);
}

}  // namespace

Comparison PrepareModels(CaseModel& full, CaseModel& thin, const Hypothesis& nominal) {
  Comparison before = Compare(full, nominal, false);
  thin.noise_model = full.noise_model;
  thin.LimitAs(full);
  PassFloorsOn(full, thin);
  UseBranchesInBoth(full, thin, nominal);
  std::vector<NuisanceKind> declared;
  if (full.data().nuisances.any()) {
    declared = NuisanceKindsOf(full, nominal, before.predicted, true);
    UseNuisancesInBoth(full, thin, declared, {}, before.effective_sample_size, 1);
  }
  AddCoilErrors(full, thin, nominal, declared, before.effective_sample_size);
  return before;
}

}  // namespace ambrig
