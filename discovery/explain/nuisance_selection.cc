#include "discovery/explain/nuisance_selection.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "discovery/decision/conclusion.h"
#include "discovery/decision/drift_test.h"
#include "discovery/decision/nuisance_choice.h"
#include "discovery/model/nuisance_kinds.h"
#include "discovery/model/residual.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/likelihood.h"
#include "discovery/search/linear_step.h"

namespace ambrig {

namespace {

// Of what the nuisances explain, for one effect in their place: its law may have another form. Of
// fewer amounts that much may follow a law by chance (eight: F = 63 on 1 and 7 degrees of freedom,
// p = 1e-4).
constexpr double kMostOfNuisances = 0.9;
constexpr std::size_t kManyAmounts = 8;
constexpr std::size_t kTried = 3;  // effects in their place

/// Whether nearly all that amounts explain would be explained by the same amount in all records of
/// a free rotor, and by one in those of a held rotor: what acts on the rotor is not seen in these.
/// An amount that few records tell says nothing.
bool AreTheSame(const Case& data, const std::vector<NuisanceFound>& amounts) {
  constexpr double kNearlyAll = 0.98;
  constexpr std::size_t kLeastRecords = 3;  // two may agree by chance
  std::map<std::string, bool> held;
  for (const CaseRecord& r : data.records)
    held[r.data_file] = r.scenario.start == StartState::kClamped;
  struct OfKind {
    std::vector<double> value, information;
    double square = 0;  // weighted
  };
  std::map<std::pair<std::string, bool>, OfKind> kinds;
  for (const NuisanceFound& f : amounts) {
    if (f.record.empty() || !(f.sd > 0)) continue;
    OfKind& k = kinds[{f.name, held[f.record]}];
    k.value.push_back(f.value);
    k.information.push_back(1 / (f.sd * f.sd));
    k.square += f.value * f.value / (f.sd * f.sd);
  }
  double all = 0, common = 0;
  for (const auto& [name, k] : kinds) {
    if (k.value.size() < kLeastRecords) continue;
    all += k.square;
    common += k.square - TestDrift(k.value, k.information).q;
  }
  return common > kNearlyAll * all;
}

}  // namespace

void NuisanceSelection::Apply() {
  models_.UseNuisances(of_records_, of_coils_.kinds, of_coils_.doubt);
}

void NuisanceSelection::UseAgain(const State& used) {
  of_records_ = used.of_records;
  of_coils_ = used.of_coils;
  models_.SetNuisances(used.models);
}

void NuisanceSelection::UseDeclared(const Hypothesis& h, const std::vector<double>& predicted) {
  if (!models_.data().nuisances.any()) return;
  UseOfRecords(NuisanceKindsOf(models_.full(), h, predicted, true));
}

void NuisanceSelection::UseOfRecords(const std::vector<NuisanceKind>& kinds) {
  of_records_ = kinds;
  Apply();
  // What nuisances explain comes off the signatures; what came off is not known any more.
  if (kinds.empty())
    models_.ForgetSignatures();
  else
    models_.signatures().TakeOffNuisances(models_.thinned());
}

void NuisanceSelection::RenewFloors(const std::vector<Target>& before) {
  of_records_ = OverNewFloors(of_records_, models_.full(), before);
  of_coils_.kinds = OverNewFloors(of_coils_.kinds, models_.thinned(), before);
  Apply();
}

void NuisanceSelection::UseOfCoils(const std::vector<NuisanceKind>& kinds, double doubt,
                                   double seen_at) {
  of_coils_.kinds = kinds;
  of_coils_.doubt = doubt;
  of_coils_.seen_at = seen_at;
  Apply();
}

void NuisanceSelection::UseNoneOfCoils() {
  of_coils_.kinds.clear();
  Apply();
}

std::vector<NuisanceKind> NuisanceSelection::ChooseFrom(const std::vector<NuisanceKind>& kinds,
                                                        const FitResult& now,
                                                        bool effects_found) const {
  const CaseModel& model = models_.thinned();
  std::vector<NuisanceKind> chosen;
  for (const NuisanceKind& few :
       ChooseNuisances(model, Thinned(kinds, models_.full(), model), now.residual,
                       RowWeight(model, 1, models_.effective_sample_size()), effects_found))
    chosen.push_back(*std::ranges::find(kinds, few.name, &NuisanceKind::name));
  return chosen;
}

std::optional<NuisanceSelection::Before> NuisanceSelection::Try(FitResult& now, double least_share,
                                                                bool effects_found) {
  const CaseModel& model = models_.thinned();
  const StageRatios before = RatiosOf(model, now);
  if (models_.data().nuisances.any() || models_.full().nuisances.differ() ||
      before.Answered() < 1.1)
    return {};
  progress_(0.05, "what may differ from record to record");
  const FitResult all = models_.AtAllRows(now);
  if (all.predicted.empty()) return {};
  const std::vector<NuisanceKind> chosen = ChooseFrom(
      NuisanceKindsOf(models_.full(), now.hypothesis, all.predicted, false), now, effects_found);
  if (chosen.empty()) return {};
  Before state = {Used(), models_.signatures(), {}};
  UseOfRecords(chosen);
  const auto give_up = [&]() -> std::optional<Before> {
    UseAgain(state.used);
    models_.signatures() = std::move(state.signatures);
    return {};
  };
  const auto explains = [&](const FitResult& after, double least) {
    return ExplainedShare(before.Answered(), RatiosOf(model, after).Answered()) >= least;
  };
  // what a linear step promises says whether a fit is worth it
  const FitResult promised = LinearlyRefitted(model, now, models_.effective_sample_size());
  if (!explains(promised, 0.6 * least_share)) return give_up();
  FitResult with = models_.FitFrom(now.hypothesis, &promised.jacobian);
  if (!explains(with, least_share)) return give_up();
  if (!effects_found && AreTheSame(models_.data(), AmountsOfNuisances(model, with.predicted)))
    return give_up();
  state.fit = std::exchange(now, std::move(with));
  log_.Step("zeros, clocks and inputs of each record", now);
  return state;
}

bool NuisanceSelection::GiveUpForOneEffect(const FitResult& bare, const FitResult& with_nuisances) {
  const CaseModel& model = models_.thinned();
  const bool many = models_.full().nuisances.count() >= kManyAmounts;
  const State used = Used();
  UseOfRecords({});
  const double before = RatiosOf(model, bare).Answered(),
               reached = RatiosOf(model, with_nuisances).Answered(),
               of_nuisances = ExplainedShare(before, reached);
  const auto explains_as_much = [&](const FitResult& fit) {
    const double after = RatiosOf(model, fit).Answered();
    return fit.converged &&
           (after < std::max(1.1, 1.03 * reached) ||
            (many && ExplainedShare(before, after) > kMostOfNuisances * of_nuisances));
  };
  ScreenOptions screen;
  screen.effective_sample_size = models_.effective_sample_size();
  const std::vector<Candidate> candidates =
      Screen(model, bare, ResidualPeaks(), screen, models_.signatures());
  std::set<std::string> tried;  // each law where it promises most
  for (const Candidate& c : candidates) {
    if (tried.size() == kTried || ExplainedShare(bare.ratio_fit, c.ratio_fit) < 0.6) break;
    if (!tried.insert(c.effect.name).second) continue;
    progress_(0.07, Named(c.effect) + " in place of the nuisances");
    if (!explains_as_much(FitBriefly(model, bare, c, models_.effective_sample_size()))) continue;
    log_.TakeBackLast();
    given_up_for_effect_ = true;
    return true;
  }
  UseAgain(used);
  models_.signatures().TakeOffNuisances(model);
  return false;
}

void NuisanceSelection::DropNeedless(FitResult& base, FitResult& now) {
  if (models_.data().nuisances.any() || !models_.full().nuisances.differ()) return;
  progress_(0.93, "without zeros, clocks and inputs of each record");
  const State used = Used();
  const SignatureBank signatures = models_.signatures();
  const double with = RatiosOf(models_.thinned(), now).Answered();
  UseOfRecords({});
  FitResult without = models_.FitFrom(now.hypothesis);
  if (without.converged &&
      RatiosOf(models_.thinned(), without).Answered() < std::max(1.05, 1.03 * with)) {
    now = std::move(without);
    base = models_.FitFrom(base.hypothesis);
    log_.Step("without differing zeros", now);
    return;
  }
  UseAgain(used);
  models_.signatures() = signatures;
}

}  // namespace ambrig
