// The columns of the nuisances: what one sd of each does to every row of a case.
#include "discovery/model/nuisance_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "core/record/channels.h"
#include "discovery/data/input_size.h"
#include "effects/catalogue.h"
#include "rig/clearance.h"

namespace ambrig {

using Eigen::Index;

namespace {

// Usual sizes where the case declares none.
constexpr double kZeroOfClearance = 0.01;  // of a position sensor
constexpr double kZeroOfCurrent = 0.002;   // of the current converter's range
constexpr double kZeroOfBus = 0.003;       // of the bus voltage
constexpr double kZeroOfForce = 0.01;      // of the rotor's weight
constexpr double kUsualShift = 1e-4;       // [s]
constexpr double kUsualGain = 0.01;

}  // namespace

double UsualZero(const RigParameters& rig, const std::string& channel) {
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& axis : b.Axes())
      if (axis == channel) return kZeroOfClearance * ClearanceOf(b);
  const auto id = ParseChannel(channel);
  if (!id) return 0;
  if (id->kind == ChannelKind::kCoilCurrent) return kZeroOfCurrent * rig.amplifier.adc_range;
  if (id->kind == ChannelKind::kLoadCell) return kZeroOfForce * rig.rotor.mass * 9.81;
  return id->kind == ChannelKind::kBus ? kZeroOfBus * rig.amplifier.bus_voltage : 0;
}

namespace {

class Builder {
 public:
  Builder(const CaseModel& model, const Hypothesis& h, const std::vector<double>& predicted,
          bool declared_only)
      : model_(model), h_(h), predicted_(predicted), declared_only_(declared_only) {}

  std::vector<NuisanceKind> Run() {
    const NuisancePriors& priors = model_.data().nuisances;
    for (const auto& [channel, unit] : Channels()) {
      const auto declared = priors.sensor_zero.find(channel);
      const bool own = declared != priors.sensor_zero.end();
      const double sd = own              ? declared->second
                        : declared_only_ ? 0
                                         : UsualZero(model_.data().rig, channel);
      if (sd <= 0) continue;
      InLoop(channel, unit, sd);
      Logged(channel, unit, sd);
    }
    const double shift = priors.time_shift > 0 ? priors.time_shift
                         : declared_only_      ? 0
                                               : kUsualShift;
    if (shift > 0) Clock(shift);
    const double gain = priors.input_gain > 0 ? priors.input_gain : declared_only_ ? 0 : kUsualGain;
    if (gain > 0) Input(gain);
    return std::move(out_);
  }

 private:
  std::vector<std::pair<std::string, std::string>> Channels() const {
    std::vector<std::pair<std::string, std::string>> out;
    for (const Target& t : model_.targets()) {
      if (!OverTime(model_.data().records[t.record])) continue;
      const Channel& c = model_.data().records[t.record].data.channels[t.channel];
      const std::pair<std::string, std::string> item{c.name, c.unit};
      if (std::find(out.begin(), out.end(), item) == out.end()) out.push_back(item);
    }
    return out;
  }

  NuisanceKind Kind(const std::string& name, NuisanceGroup group, const std::string& unit,
                    double sd) const {
    return {name, group, unit, sd, StretchColumn(static_cast<Index>(model_.size()))};
  }

  /// Appends the rows of a target; `value(k)` of its k-th row, asked for where that row counts.
  template <class Value>
  void AppendRows(NuisanceKind& kind, const Target& t, const Value& value) const {
    Eigen::VectorXd rows = Eigen::VectorXd::Zero(static_cast<Index>(t.count));
    for (std::size_t k = 0; k < t.count; ++k)
      if (model_.ok()[t.first + k]) rows(static_cast<Index>(k)) = value(k);
    kind.column.Append(static_cast<Index>(t.first), std::move(rows));
  }

  /// The difference of a changed prediction, which is that of one sd.
  void Simulated(NuisanceKind kind, const std::optional<std::vector<double>>& changed) {
    if (!changed) return;
    for (const Target& t : model_.targets())
      AppendRows(kind, t, [&](std::size_t k) {
        return ((*changed)[t.first + k] - predicted_[t.first + k]) / t.floor;
      });
    out_.push_back(std::move(kind));
  }

  /// A zero that the control loop sees.
  void InLoop(const std::string& channel, const std::string& unit, double sd) {
    const RigParameters& rig = model_.data().rig;
    std::string effect, target;
    for (const std::string& axis : AxisNames(rig))
      if (axis == channel) effect = "sensor-offset", target = axis;
    // the currents' loops only where the case asks for it: a simulation for every coil
    const auto id = ParseChannel(channel);
    if (id && id->kind == ChannelKind::kCoilCurrent &&
        model_.data().nuisances.sensor_zero.contains(channel)) {
      effect = "current-sensor-offset";
      target = CoilName(id->plane, id->index);
    }
    if (effect.empty()) return;
    Hypothesis moved = h_;
    EffectInstance e = MakeInstance(EffectNamed(effect), target);
    e.Set("offset", sd);
    moved.rig.effects.push_back(e);
    Simulated(Kind("zero of " + channel, NuisanceGroup::kSensorZero, unit, sd),
              model_.Predict(moved));
  }

  /// A zero of the logger alone, and its drift over the record.
  void Logged(const std::string& channel, const std::string& unit, double sd) {
    NuisanceKind zero = Kind("logger zero of " + channel, NuisanceGroup::kLoggerZero, unit, sd),
                 drift = Kind("drift of " + channel, NuisanceGroup::kDrift, unit, sd);
    for (const Target& t : model_.targets()) {
      const CaseRecord& r = model_.data().records[t.record];
      if (!OverTime(r) || r.data.channels[t.channel].name != channel) continue;
      AppendRows(zero, t, [&](std::size_t) { return sd / t.floor; });
      AppendRows(drift, t, [&](std::size_t k) {
        return sd / t.floor * (2 * static_cast<double>(k) / static_cast<double>(t.count) - 1);
      });
    }
    out_.push_back(std::move(zero));
    out_.push_back(std::move(drift));
  }

  /// The record's clock late by `sd`: the prediction's slope.
  void Clock(double sd) {
    NuisanceKind kind = Kind(kTimeShift, NuisanceGroup::kTimeShift, "s", sd);
    for (const Target& t : model_.targets()) {
      if (!OverTime(model_.data().records[t.record])) continue;
      const double rate = model_.data().records[t.record].data.rate;
      AppendRows(kind, t, [&](std::size_t k) {
        const std::size_t row = t.first + k;
        if (k == 0 || k + 1 == t.count || !model_.ok()[row - 1] || !model_.ok()[row + 1])
          return 0.0;
        return -sd * 0.5 * rate * (predicted_[row + 1] - predicted_[row - 1]) / t.floor;
      });
    }
    out_.push_back(std::move(kind));
  }

  /// All commanded signals larger by `sd`.
  void Input(double sd) {
    const std::vector<CaseRecord>& records = model_.data().records;
    if (std::ranges::all_of(records,
                            [](const CaseRecord& r) { return r.scenario.excitations.empty(); }))
      return;
    const Case larger = WithInputs(model_.data(), std::vector<double>(records.size(), sd));
    CaseModel trial(larger);
    trial.stop = model_.stop;
    Simulated(Kind(kInputGain, NuisanceGroup::kInputGain, "-", sd), trial.Predict(h_));
  }

  const CaseModel& model_;
  const Hypothesis& h_;
  const std::vector<double>& predicted_;
  bool declared_only_;
  std::vector<NuisanceKind> out_;
};

}  // namespace

std::vector<NuisanceKind> NuisanceKindsOf(const CaseModel& model, const Hypothesis& h,
                                          const std::vector<double>& predicted,
                                          bool declared_only) {
  return Builder(model, h, predicted, declared_only).Run();
}

}  // namespace ambrig
