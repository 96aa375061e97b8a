#include "discovery/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/case/test_records.h"
#include "discovery/decision/prepared_models.h"
#include "discovery/experiment/measured_case.h"
#include "discovery/model/nuisance_kinds.h"
#include "discovery/plan/planner.h"
#include "discovery/search/likelihood.h"
#include "discovery/search/signature_bank.h"
#include "discovery/shape/named_law.h"
#include "effects/usual_size.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rig/rig_channels.h"

namespace ambrig {

using Eigen::Index;

namespace {

constexpr double kUnknownSize = 3;  // sd of an effect's number without records, in steps
constexpr double kDrawnSize = 0.3;  // the same in simulated records: about its usual size
constexpr std::size_t kPlanRows = 150000;

/// What prior and records say of the free parameters, in coordinates.
Eigen::MatrixXd PrecisionOf(const CaseModel& model, const FitResult& fit, double n) {
  const double weight = RowWeight(model, fit.ratio_fit, n);
  const Gram gram = RowProducts(model, fit.jacobian, fit.jacobian);
  Eigen::MatrixXd P = weight * (gram.fit + gram.validate);
  for (Index k = 0; k < P.rows(); ++k)
    P(k, k) += fit.hypothesis.free[static_cast<std::size_t>(k)].sd > 0 ? 1 : 1e-4;
  return P;
}

/// What a record will have of its own: as declared; else zeros of the position sensors of usual
/// size, which differ from record to record on most rigs and are told by no one.
NuisancePriors NuisancesToExpect(const RigParameters& rig, const NuisancePriors& declared) {
  NuisancePriors out = declared;
  if (out.any()) return out;
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& axis : b.Axes()) out.sensor_zero[axis] = UsualZero(rig, axis);
  return out;
}

/// Rig parameters by their prior, numbers of effects with `sd` in steps.
Eigen::MatrixXd PriorPrecision(const Hypothesis& h, double sd) {
  Eigen::VectorXd P(static_cast<Index>(h.free.size()));
  for (std::size_t k = 0; k < h.free.size(); ++k)
    P(static_cast<Index>(k)) = h.free[k].sd > 0 ? 1 : 1 / (sd * sd);
  return P.asDiagonal();
}

}  // namespace

EffectNames NamesLeft(const Explanation& e, std::size_t most) {
  EffectNames names;
  for (const SetMember& m : e.set)
    if (m.effect != "unknown" && m.effect != "data" && names.size() < most)
      names.emplace_back(m.effect, m.target);
  for (const RankedEffect& r : e.ranking) {
    const auto name = std::pair(r.effect.name, r.effect.target);
    if (names.size() < 2 && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names;
}

Plan PlanForCase(const Case& c, const EffectNames& names, const PlanOptions& options) {
  if (const std::optional<Case> seen = WithoutTestRecords(c))
    return PlanForCase(*seen, names, options);
  const auto progress = [&](double f, const std::string& text) {
    if (options.stop && options.stop->load()) throw Interrupted();
    if (options.progress) options.progress(f, text);
  };
  CaseModel full(c), thin(c, ThinningTo(c, kPlanRows));
  full.stop = thin.stop = options.stop;
  progress(0, "noise floor");
  const Comparison filed = PrepareModels(full, thin, Hypothesis::Base(c.rig));
  std::map<std::string, double> noise = c.noise;
  for (const auto& [channel, n] : filed.noise.channels)
    if (std::isfinite(n.used)) noise[channel] = n.used;
  FitOptions fit;
  fit.effective_sample_size = filed.effective_sample_size;
  const FitResult base = Fit(thin, Hypothesis::Base(c.rig), fit);
  std::vector<Rival> rivals;
  for (const auto& [effect, target] : names) {
    progress(0.02 + 0.25 * static_cast<double>(rivals.size()) / static_cast<double>(names.size()),
             effect);
    if (effect == "nothing") {
      const Eigen::MatrixXd P = PrecisionOf(thin, base, fit.effective_sample_size);
      rivals.push_back({effect, "", base.hypothesis, P, P});
      continue;
    }
    const NamedLaw law = FitNamedLaw(thin, effect, target, fit.effective_sample_size,
                                     [](double, const std::string&) {});
    const Eigen::MatrixXd P = PrecisionOf(thin, law.fit, fit.effective_sample_size);
    rivals.push_back(
        {effect, law.fit.hypothesis.rig.effects[law.index].target, law.fit.hypothesis, P, P});
  }
  Planner planner(c.rig, AbilitiesOf(c), {noise, NuisancesToExpect(c.rig, c.nuisances)}, rivals,
                  base.hypothesis, options);
  Plan plan = planner.Run();
  for (const DataFault& f : filed.data)
    plan.warnings.push_back("the data of this case are wrong: " + FaultText(f));
  plan.runs += full.runs + thin.runs;
  return plan;
}

Plan PlanForRig(const RigParameters& rig, const EffectNames& effects, const Abilities& abilities,
                const PlanOptions& options) {
  const Hypothesis base = Hypothesis::Base(rig);
  std::vector<Rival> rivals = {
      {"nothing", "", base, PriorPrecision(base, 1), PriorPrecision(base, 1)}};
  for (const auto& [effect, target] : effects) {
    const EffectDescription& d = EffectNamed(effect);
    if (d.users_own)
      throw InputError(effect +
                       " has no usual size, allowed: an effect that `ambrig explain` "
                       "proposes");
    const std::vector<std::string> possible = TargetsOf(d, TargetsOfEffects(rig));
    if (possible.empty())
      throw InputError(fmt::format("{}: this rig has no target for this effect", effect));
    const std::string at = target.empty() ? possible[0] : target;
    if (std::find(possible.begin(), possible.end(), at) == possible.end())
      throw InputError(
          fmt::format("{}@{}: no such target, allowed: {}", effect, at, fmt::join(possible, ", ")));
    Hypothesis h = base;
    h.AddEffect(AtUsualSize(d, at));
    rivals.push_back(
        {effect, at, h, PriorPrecision(h, kUnknownSize), PriorPrecision(h, kDrawnSize)});
  }
  std::map<std::string, double> noise;
  noise[ChannelId{ChannelKind::kBus}.name()] = kUsualBusNoise;
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->two_axes)
      for (const ChannelId& cell : ChannelsOf(b, ChannelKind::kLoadCell))
        noise[cell.name()] = UsualLoadCellNoise(rig);
  return Planner(rig, abilities, {noise, NuisancesToExpect(rig, {})}, rivals, base, options).Run();
}

}  // namespace ambrig
