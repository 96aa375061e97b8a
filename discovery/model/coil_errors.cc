#include "discovery/model/coil_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "discovery/model/branch_rows.h"
#include "discovery/model/case_model.h"
#include "discovery/model/residual.h"
#include "effects/catalogue.h"

namespace ambrig {

using Eigen::Index;

namespace {

constexpr double kSpreads = 5;        // beyond what a search believes to be errors of coils
constexpr std::size_t kTogether = 8;  // predictions that are in memory together

/// One error of one coil, as an effect of the size of one sd.
struct CoilError {
  std::string name;
  NuisanceGroup group = NuisanceGroup::kCurrentGain;
  std::string unit;
  double sd = 0;
  EffectInstance effect;
};

/// The mean voltage that a bridge gives too much when its on-phase ends late [V/s].
double VoltsOfEdge(const AmplifierParameters& a) {
  switch (a.modulation) {
    case Modulation::kBiState:
      return 2 * a.bus_voltage * a.switching_frequency;
    case Modulation::kIdeal:
      return 0;
    default:
      return a.bus_voltage * a.switching_frequency;
  }
}

void AddErrorsOfCoil(const AmplifierParameters& a, const std::string& bearing, int coil,
                     std::vector<CoilError>& out) {
  const std::string target = CoilName(bearing, coil - 1),
                    channel = fmt::format("{}.i{}", bearing, coil);
  const auto add = [&](NuisanceGroup group, const char* unit, double sd, const char* effect,
                       const char* parameter, double value) {
    EffectInstance e = MakeInstance(EffectNamed(effect), target);
    e.Set(parameter, value);
    out.push_back({fmt::format("{} of {}", ToText(group), channel), group, unit, sd, e});
  };
  if (a.current_gain_spread > 0)
    add(NuisanceGroup::kCurrentGain, "-", a.current_gain_spread, "current-sensor-gain", "gain",
        1 + a.current_gain_spread);
  if (a.edge_spread > 0 && VoltsOfEdge(a) > 0)
    add(NuisanceGroup::kEdge, "s", a.edge_spread, "amplifier-offset", "offset",
        VoltsOfEdge(a) * a.edge_spread);
}

std::vector<CoilError> ErrorsOfCoils(const RigParameters& rig) {
  std::vector<CoilError> errors;
  for (const BearingParameters& b : rig.bearings)
    for (int coil = 1; coil <= b.coils(); ++coil)
      AddErrorsOfCoil(rig.amplifier, b.name, coil, errors);
  return errors;
}

/// The change over the floor as a column, without the stretches that it leaves as they are.
StretchColumn ColumnOf(const CaseModel& model, const std::vector<double>& change) {
  StretchColumn column(static_cast<Index>(model.size()));
  for (const Target& t : model.targets()) {
    Eigen::VectorXd rows =
        Eigen::Map<const Eigen::VectorXd>(change.data() + t.first, static_cast<Index>(t.count));
    if (!rows.isZero(0)) column.Append(static_cast<Index>(t.first), std::move(rows));
  }
  return column;
}

}  // namespace

std::vector<NuisanceKind> CoilErrorKinds(const CaseModel& model, const Hypothesis& h) {
  const std::vector<CoilError> errors = ErrorsOfCoils(h.rig);
  std::vector<NuisanceKind> out;
  std::vector<double> change(model.size());
  for (std::size_t first = 0; first < errors.size(); first += kTogether) {
    const std::size_t count = std::min(kTogether, errors.size() - first);
    std::vector<Hypothesis> all(1 + count, h);
    for (std::size_t k = 0; k < count; ++k)
      all[1 + k].rig.effects.push_back(errors[first + k].effect);
    const auto predicted = model.PredictAll(all, ModelFidelity::kCoarse);
    for (std::size_t k = 0; predicted[0] && k < count; ++k) {
      if (!predicted[1 + k]) continue;
      ChangeOverFloor(model, *predicted[0], *predicted[1 + k], change.data());
      DropJumps(model, change.data());
      const CoilError& e = errors[first + k];
      out.push_back(
          {e.name, e.group, e.unit, e.sd, ColumnOf(model, change), true, e.effect.target});
    }
  }
  return out;
}

bool IsWithinCoilErrors(const EffectInstance& effect, const RigParameters& rig) {
  for (const CoilError& e : ErrorsOfCoils(rig)) {
    if (e.effect.name != effect.name || e.effect.target != effect.target) continue;
    bool within = true;
    for (std::size_t k = 0; k < effect.table.size(); ++k) {
      const double null = effect.table[k].null_value;
      within = within &&
               std::abs(effect.values[k] - null) <= kSpreads * std::abs(e.effect.values[k] - null);
    }
    return within;
  }
  return false;
}

void AddCoilErrors(const std::vector<NuisanceFound>& found, RigParameters& rig) {
  for (BearingParameters& b : rig.bearings)
    for (int coil = 1; coil <= b.coils(); ++coil)
      for (const NuisanceFound& f : found) {
        if (f.coil != CoilName(b.name, coil - 1)) continue;
        std::vector<double>& all = f.group == NuisanceGroup::kCurrentGain
                                       ? b.coil_errors.current_gain
                                       : b.coil_errors.edge;
        all.resize(static_cast<std::size_t>(b.coils()));
        all[static_cast<std::size_t>(coil - 1)] += f.value;
      }
}

}  // namespace ambrig
