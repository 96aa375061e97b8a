#include "discovery/decision/unit_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/record/channels.h"
#include "discovery/model/residual.h"
#include "simulation/sampled/coil_spread.h"

namespace ambrig {

namespace {

constexpr int kUnits = 12;
constexpr double kMore = 1.25;  // of the squared error: a unit may lie beyond those that are drawn
constexpr double kByChance = 1.1;  // of the rms of a noisy channel

/// A record and a kind of channel: all coils of a machine differ alike.
using RecordAndKind = std::pair<std::size_t, int>;
RecordAndKind CoilKindOf(const CaseModel& model, const Target& t) {
  const auto id = ParseChannel(model.data().records[t.record].data.channels[t.channel].name);
  return {t.record, id ? static_cast<int>(id->kind) : -1};
}

/// Takes over what is larger, the noise of a measurement on top.
void TakeLarger(double& most, double ratio) {
  most = std::max(most, std::sqrt(1 + kMore * ratio * ratio));
}

}  // namespace

std::vector<std::vector<double>> ChangesOfUnits(const CaseModel& model, const Hypothesis& h) {
  std::vector<std::vector<double>> changes;
  if (!CoilsDiffer(h.rig.amplifier)) return changes;
  std::vector<Hypothesis> all(1 + kUnits, h);
  for (int k = 1; k <= kUnits; ++k) all[static_cast<std::size_t>(k)].rig.amplifier.unit += k;
  const auto predicted = model.PredictAll(all, ModelFidelity::kCoarse);
  for (std::size_t unit = 1; predicted[0] && unit < all.size(); ++unit) {
    if (!predicted[unit]) continue;
    changes.emplace_back(model.size());
    ChangeOverFloor(model, *predicted[0], *predicted[unit], changes.back().data());
  }
  return changes;
}

UnitErrors ErrorsOfUnits(const CaseModel& model, const std::vector<std::vector<double>>& changes) {
  UnitErrors errors;
  std::map<RecordAndKind, double> most;
  for (std::vector<double> d : changes) {
    LimitInBranches(model, d.data());
    if (model.nuisances.any()) model.nuisances.Eliminate(d.data());
    for (const Which records : {Which::kFit, Which::kValidate})
      TakeLarger(errors.largest, Ratio(model, d, records));
    for (const Target& t : model.targets())
      TakeLarger(most.try_emplace(CoilKindOf(model, t), 1).first->second, TargetRatio(model, d, t));
  }
  if (!most.empty())
    for (const Target& t : model.targets()) errors.most.push_back(most.at(CoilKindOf(model, t)));
  return errors;
}

bool IsWithinUnits(const CaseModel& model, const std::vector<double>& residual,
                   const UnitErrors& of_units) {
  for (std::size_t t = 0; t < of_units.most.size(); ++t)
    if (TargetRatio(model, residual, model.targets()[t]) > kByChance * of_units.most[t])
      return false;
  return !of_units.most.empty();
}

std::string SaidOfCoils(const CaseModel& model, const Hypothesis& h,
                        const std::vector<double>& residual) {
  constexpr double kNoiseAlone = 1.05, kSeen = 1.01;
  if (!CoilsDiffer(h.rig.amplifier) || Ratio(model, residual, Which::kAll) < kNoiseAlone) return "";
  const UnitErrors units = ErrorsOfUnits(model, ChangesOfUnits(model, h));
  if (units.most.empty() || units.largest < kSeen) return "";
  return fmt::format(
      "the coils of machines of this type, which differ as the rig file states, make up to {:.2f} "
      "times the noise: {}",
      units.largest,
      IsWithinUnits(model, residual, units)
          ? "nothing here is more (ambrig explain estimates the error of each coil)"
          : "some channels show more");
}

}  // namespace ambrig
