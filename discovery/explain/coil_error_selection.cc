#include "discovery/explain/coil_error_selection.h"

#include <algorithm>
#include <numeric>

#include "core/base/coil_name.h"
#include "discovery/decision/coil_choice.h"
#include "discovery/decision/conclusion.h"
#include "discovery/model/coil_errors.h"
#include "discovery/search/linear_step.h"
#include "simulation/sampled/coil_spread.h"

namespace ambrig {

namespace {

constexpr double kNoise = 1.02;  // error over the noise up to which nothing is to be explained
constexpr double kFallen = 0.5;  // of the squared error beside the noise: they are then seen better

}  // namespace

bool CoilErrorSelection::MayBeOne(const EffectInstance& e) const {
  return any() && NamesCoil(e.target);
}

void CoilErrorSelection::Use(const FitResult& as_filed, FitResult& base) {
  if (!CoilsDiffer(models_.rig().amplifier) ||
      RatiosOf(models_.thinned(), base).Answered() < kNoise)
    return;
  progress_(0.04, "what the coils differ by");
  Find(as_filed);
  if (!any()) return;
  Allow(as_filed, {});
  models_.ForgetSignatures();
  const FitResult promised =
      LinearlyRefitted(models_.thinned(), as_filed, models_.effective_sample_size());
  base = models_.FitFrom(as_filed.hypothesis, &promised.jacobian);
  log_.Step("errors of single coils", base);
}

void CoilErrorSelection::Find(const FitResult& as_filed) {
  possible_ = CoilErrorKinds(models_.thinned(), as_filed.hypothesis);
  unit_changes_ = ChangesOfUnits(models_.thinned(), as_filed.hypothesis);
  as_filed_jacobian_ = as_filed.jacobian;
}

void CoilErrorSelection::RenewFloors(const Hypothesis& as_filed, const FitResult& now,
                                     const std::vector<EffectInstance>& effects) {
  nuisances_.UseNoneOfCoils();
  Find(models_.At(as_filed));
  Allow(now, effects);
}

FitResult CoilErrorSelection::Without(const FitResult& now) {
  nuisances_.UseNoneOfCoils();
  const CaseModel& model = models_.thinned();
  FitResult bare = now;
  bare.residual = Residual(model, now.predicted);
  // of the rig's parameters as the rig file has them, of the adopted effects here
  bare.jacobian = as_filed_jacobian_;
  if (model.nuisances.any()) model.nuisances.Eliminate(bare.jacobian);
  const auto rig = static_cast<std::size_t>(as_filed_jacobian_.cols());
  std::vector<std::size_t> adopted(now.hypothesis.free.size() - rig);
  if (adopted.empty()) return bare;
  std::iota(adopted.begin(), adopted.end(), rig);
  bare.jacobian.conservativeResize(Eigen::NoChange,
                                   static_cast<Eigen::Index>(now.hypothesis.free.size()));
  bare.jacobian.rightCols(static_cast<Eigen::Index>(adopted.size())) =
      Jacobian(model, now.hypothesis, adopted);
  return bare;
}

void CoilErrorSelection::Allow(const FitResult& now, const std::vector<EffectInstance>& effects) {
  const FitResult bare = Without(now);
  std::vector<NuisanceKind> believable = possible_;
  std::erase_if(believable, [&](const NuisanceKind& kind) {
    return std::ranges::count(effects, kind.coil, &EffectInstance::target) > 0;
  });
  const CoilErrorChoice choice =
      ChooseCoilErrors(models_.thinned(), believable, bare, models_.effective_sample_size());
  nuisances_.UseOfCoils(choice.kinds, choice.doubt, now.ratio_fit);
  nuisances_.SetOfUnits(ErrorsOfUnits(models_.thinned(), unit_changes_));
}

void CoilErrorSelection::Renew(FitResult& now, const std::vector<EffectInstance>& effects) {
  const auto excess = [](double ratio) { return std::max(0.0, ratio * ratio - 1); };
  if (!any() || excess(now.ratio_fit) > kFallen * excess(nuisances_.of_coils().seen_at)) return;
  Allow(now, effects);
  models_.signatures().TakeOffNuisances(models_.thinned());
  now = models_.FitFrom(now.hypothesis);
}

bool CoilErrorSelection::ExplainInstead(const std::vector<EffectInstance>& effects,
                                        std::size_t index, const FitResult& now,
                                        FitResult& without) {
  if (!MayBeOne(effects[index])) return false;
  const NuisanceSelection::State used = nuisances_.Used();
  std::vector<EffectInstance> others = effects;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
  Allow(without, others);
  FitResult beside = models_.FitFrom(without.hypothesis);
  if (RatiosOf(models_.thinned(), beside).Answered() <
      std::max(kNoise, 1.03 * RatiosOf(models_.thinned(), now).Answered())) {
    without = std::move(beside);
    return true;
  }
  nuisances_.UseAgain(used);
  return false;
}

void CoilErrorSelection::StateSd(const FitResult& now, std::vector<NuisanceFound>& found) {
  const NuisanceSelection::State used = nuisances_.Used();
  const std::vector<NuisanceKind>& kinds = used.of_coils.kinds;
  if (kinds.empty()) return;
  const std::vector<double> sd = SdOfCoilErrors(
      models_.thinned(), kinds, Without(now), models_.effective_sample_size(), used.of_coils.doubt);
  nuisances_.UseAgain(used);
  for (NuisanceFound& f : found)
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (f.record.empty() && f.name == kinds[k].name) f.sd = sd[k];
}

}  // namespace ambrig
