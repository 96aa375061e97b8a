// Steps of the search: what the coils of any machine of the type differ by, as the rig file states, is no effect.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/base/coil_name.h"
#include "discovery/decision/coil_choice.h"
#include "discovery/decision/conclusion.h"
#include "discovery/decision/prepared_models.h"
#include "discovery/explain/explanation_search.h"
#include "discovery/model/coil_errors.h"
#include "discovery/model/residual.h"
#include "discovery/search/linear_step.h"
#include "discovery/search/screen.h"
#include "simulation/sampled/coil_spread.h"

namespace ambrig {

namespace {

constexpr double kNoise = 1.02;  // error over the noise up to which nothing is to be explained
constexpr double kFallen = 0.5;  // of the squared error beside the noise: they are then seen better

}  // namespace

void Explainer::ApplyNuisances() {
  UseNuisancesInBoth(full_, model_, record_kinds_, coil_kinds_, out_.effective_sample_size,
                     coil_doubt_);
}

Explainer::UsedNuisances Explainer::Used() const {
  return {record_kinds_, coil_kinds_,     coil_doubt_,     coils_seen_at_,
          of_units_,     full_.nuisances, model_.nuisances};
}

void Explainer::UseAgain(const UsedNuisances& used) {
  record_kinds_ = used.of_records;
  coil_kinds_ = used.of_coils;
  coil_doubt_ = used.coil_doubt;
  coils_seen_at_ = used.coils_seen_at;
  of_units_ = used.of_units;
  full_.nuisances = used.full;
  model_.nuisances = used.thinned;
}

void Explainer::UseCoilErrors(const FitResult& as_filed, FitResult& now) {
  if (!CoilsDiffer(rig_.amplifier) || RatiosOf(model_, now).Answered() < kNoise) return;
  Progress(0.04, "what the coils differ by");
  FindCoilErrors(as_filed);
  if (coil_errors_.empty()) return;
  AllowCoilErrors(as_filed);
  bank_ = SignatureBank();
  const FitResult promised = LinearlyRefitted(model_, as_filed, out_.effective_sample_size);
  now = FitNow(as_filed.hypothesis, &promised.jacobian);
  out_.base_ratio_fit = now.ratio_fit;
  out_.base_ratio_validate = now.ratio_validate;
  out_.ladder.push_back({"errors of single coils", now.ratio_fit, now.ratio_validate});
}

void Explainer::FindCoilErrors(const FitResult& as_filed) {
  coil_errors_ = CoilErrorKinds(model_, as_filed.hypothesis);
  unit_changes_ = ChangesOfUnits(model_, as_filed.hypothesis);
  as_filed_jacobian_ = as_filed.jacobian;
}

void Explainer::RenewCoilFloors(const Hypothesis& as_filed, const FitResult& now) {
  coil_kinds_.clear();
  ApplyNuisances();
  FindCoilErrors(At(as_filed));
  AllowCoilErrors(now);
}

FitResult Explainer::WithoutCoilErrors(const FitResult& now) {
  coil_kinds_.clear();
  ApplyNuisances();
  FitResult bare = now;
  bare.residual = Residual(model_, now.predicted);
  // of the rig's parameters as the rig file has them, of the adopted effects here
  bare.jacobian = as_filed_jacobian_;
  if (model_.nuisances.any()) model_.nuisances.Eliminate(bare.jacobian);
  const auto rig = static_cast<std::size_t>(as_filed_jacobian_.cols());
  std::vector<std::size_t> adopted(now.hypothesis.free.size() - rig);
  if (adopted.empty()) return bare;
  std::iota(adopted.begin(), adopted.end(), rig);
  bare.jacobian.conservativeResize(Eigen::NoChange,
                                   static_cast<Eigen::Index>(now.hypothesis.free.size()));
  bare.jacobian.rightCols(static_cast<Eigen::Index>(adopted.size())) =
      Jacobian(model_, now.hypothesis, adopted);
  return bare;
}

void Explainer::AllowCoilErrors(const FitResult& now) {
  const FitResult bare = WithoutCoilErrors(now);
  std::vector<NuisanceKind> possible = coil_errors_;
  std::erase_if(possible, [&](const NuisanceKind& kind) {
    return std::any_of(out_.adopted.begin(), out_.adopted.end(),
                       [&](const EffectInstance& e) { return e.target == kind.coil; });
  });
  CoilErrorChoice choice = ChooseCoilErrors(model_, possible, bare, out_.effective_sample_size);
  coil_kinds_ = std::move(choice.kinds);
  coil_doubt_ = choice.doubt;
  coils_seen_at_ = now.ratio_fit;
  ApplyNuisances();
  of_units_ = ErrorsOfUnits(model_, unit_changes_);
}

void Explainer::RenewCoilErrors(FitResult& now) {
  const auto excess = [](double ratio) { return std::max(0.0, ratio * ratio - 1); };
  if (coil_errors_.empty() || excess(now.ratio_fit) > kFallen * excess(coils_seen_at_)) return;
  AllowCoilErrors(now);
  bank_.TakeOffNuisances(model_);
  now = FitNow(now.hypothesis, nullptr);
}

void Explainer::StateSdOfCoilErrors(const FitResult& now) {
  if (coil_kinds_.empty()) return;
  const std::vector<NuisanceKind> kinds = coil_kinds_;
  const UsedNuisances used = Used();
  const std::vector<double> sd = SdOfCoilErrors(model_, kinds, WithoutCoilErrors(now),
                                                out_.effective_sample_size, coil_doubt_);
  UseAgain(used);
  for (NuisanceFound& f : out_.nuisances)
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (f.record.empty() && f.name == kinds[k].name) f.sd = sd[k];
}

bool Explainer::CoilErrorsExplain(std::size_t adopted, const FitResult& now, FitResult& without) {
  if (coil_errors_.empty() || !NamesCoil(out_.adopted[adopted].target)) return false;
  const UsedNuisances used = Used();
  const std::vector<EffectInstance> all = out_.adopted;
  out_.adopted.erase(out_.adopted.begin() + static_cast<std::ptrdiff_t>(adopted));
  AllowCoilErrors(without);
  FitResult beside = FitNow(without.hypothesis, nullptr);
  out_.adopted = all;
  if (RatiosOf(model_, beside).Answered() <
      std::max(kNoise, 1.03 * RatiosOf(model_, now).Answered())) {
    without = std::move(beside);
    return true;
  }
  UseAgain(used);
  return false;
}

}  // namespace ambrig
