// Units, signs and exchanged columns: what a factor or another column brings back to the model.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/data/data_gate.h"
#include "discovery/data/noise_estimate.h"

namespace ambrig {

namespace {

/// A factor that a mistake makes, and what has to be so for it to be believed.
struct Mistake {
  double factor;
  double left;         // largest share of the error that may remain
  double correlation;  // least correlation with the prediction
  bool alone;          // the other columns of the record must be far better than this one
};

/// Prefixes need no shape: nothing real is a thousand times off. A factor of two has to fit
/// perfectly and alone, because an effect inside the loop may come near it.
const std::vector<Mistake>& Mistakes() {
  static const std::vector<Mistake> kAll = {
      {1e3, 0.25, 0, false},
      {1e-3, 0.25, 0, false},
      {1e6, 0.25, 0, false},
      {1e-6, 0.25, 0, false},
      {60 / (2 * kPi), 0.15, 0.9, false},
      {2 * kPi / 60, 0.15, 0.9, false},
      {180 / kPi, 0.15, 0.9, false},
      {kPi / 180, 0.15, 0.9, false},
      {2 * kPi, 0.15, 0.9, true},
      {1 / (2 * kPi), 0.15, 0.9, true},
      {9.81, 0.15, 0.9, true},
      {1 / 9.81, 0.15, 0.9, true},
      {25.4, 0.15, 0.9, true},
      {1 / 25.4, 0.15, 0.9, true},
      {2, 0.08, 0.98, true},
      {0.5, 0.08, 0.98, true},
      {std::sqrt(2.0), 0.05, 0.99, true},
      {std::sqrt(0.5), 0.05, 0.99, true},
  };
  return kAll;
}

constexpr double kZeroSds = 4;

/// The largest zero that the sensor of a channel may have [SI]: two that stand still and differ by no
/// more are not told apart.
double MostZero(const CaseModel& model, const std::string& channel) {
  const auto& declared = model.data().nuisances.sensor_zero;
  const auto own = declared.find(channel);
  const double usual = UsualZero(model.data().rig, channel);
  return kZeroSds * (own == declared.end() ? usual : std::max(own->second, usual));
}

/// rms of measured minus predicted [floors], less a constant of at most `zero` [SI].
double ErrorBesideZero(const GateColumn& c, const std::vector<double>& predicted, double zero) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < c.column.size(); ++k)
    if (c.column.ok[k]) sum += c.column.measured[k] - predicted[k], n += 1;
  const double most = zero / c.floor, mean = n > 0 ? std::clamp(sum / n, -most, most) : 0;
  std::vector<double> shifted = predicted;
  for (double& p : shifted) p += mean;
  return ErrorAgainst(c.column.measured, shifted, c.column.ok);
}

/// rms of measured/factor - predicted, over the error beside a zero of the sensor.
double Left(const GateColumn& c, double factor, double error) {
  return ErrorAgainst(c.column.measured, c.column.predicted, c.column.ok, factor) /
         std::abs(factor) / error;
}

/// Where the model expects nothing but noise, a factor shows in the noise alone.
bool NoiseTells(const GateColumn& c, double factor) {
  constexpr double kNothing = 3;  // floors
  if (factor < 1 || c.match.predicted_rms > kNothing) return true;
  return WhiteNoiseOf(c.column.measured.data(), c.column.ok.data(), c.column.size()) > 0.3 * factor;
}

/// Median error of the record's other columns.
double OthersError(const std::vector<GateColumn>& columns, const GateColumn& of) {
  std::vector<double> errors;
  for (const GateColumn& c : columns)
    if (&c != &of) errors.push_back(c.match.error);
  if (errors.empty()) return 0;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

DataFault FaultOf(const CaseRecord& r, const std::string& channel, const char* fault, double left) {
  DataFault f;
  f.record = r.data_file;
  f.channel = channel;
  f.fault = fault;
  f.probability = std::clamp(1 - left * left, 0.5, 0.999);
  return f;
}

/// A column that stands at a level and hardly moves (the bus): its movement is noise and has no
/// correlation with the prediction, but the level itself shows the factor.
bool LevelTells(const GateColumn& c) {
  return c.match.predicted_rms > 20 * kGrossError &&
         c.match.predicted_move < 0.05 * c.match.predicted_rms &&
         c.match.measured_move < 0.05 * c.match.measured_rms;
}

const Mistake* BestMistake(const GateColumn& c, double error, double others, double* left) {
  const Mistake* best = nullptr;
  *left = 1;
  for (const Mistake& m : Mistakes()) {
    const double rest = Left(c, m.factor, error);
    if (rest > m.left || rest >= *left || !NoiseTells(c, m.factor)) continue;
    if (!LevelTells(c) && c.match.correlation < m.correlation) continue;
    // divided by the factor the column must still show what the model expects, its noise at least:
    // a movement that the model lacks is no unit
    if (c.match.measured_rms / m.factor < 0.3 * std::max(1.0, c.match.predicted_rms)) continue;
    if (m.alone && (error < 2 * kGrossError || others > 0.2 * error)) continue;
    best = &m;
    *left = rest;
  }
  return best;
}

}  // namespace

std::string UnitLine(const CaseRecord& r, const std::string& channel, double factor) {
  const auto it = r.sources.find(channel);
  const ColumnSource source = it == r.sources.end() ? ColumnSource{channel, "", 1} : it->second;
  const double right = source.factor / factor;  // SI per number in the file
  static constexpr std::array<std::pair<double, const char*>, 4> kPrefixes = {
      {{1, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e3, "k"}}};
  for (const auto& [size, prefix] : kPrefixes)
    if (std::abs(right / size - 1) < 1e-6)
      return fmt::format("channels.\"{}\" = {{ column = \"{}\", unit = \"{}{}\" }}", channel,
                         source.column, prefix, source.si);
  return fmt::format("channels.\"{}\" = {{ column = \"{}\", unit = \"{}\", gain = {:.9g} }}",
                     channel, source.column, source.si, source.factor / factor);
}

void CheckUnits(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  for (GateColumn& c : columns) {
    const double error = ErrorBesideZero(c, c.column.predicted, MostZero(model, c.name));
    if (c.explained || error < kGrossError) continue;
    double left = 1;
    const double others = OthersError(columns, c);
    if (const Mistake* m = BestMistake(c, error, others, &left)) {
      DataFault f = FaultOf(r, c.name, "unit", left);
      f.factor = m->factor;
      f.mend = UnitLine(r, c.name, m->factor);
      out.push_back(f);
      c.explained = true;
    } else if (c.match.correlation < -0.7 && Left(c, -1, error) < 0.3) {
      DataFault f = FaultOf(r, c.name, "sign", Left(c, -1, error));
      f.factor = -1;
      f.mend = UnitLine(r, c.name, -1);
      out.push_back(f);
      c.explained = true;
    }
  }
}

void CheckSwaps(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const auto kind = [](const GateColumn& c) {  // columns along the shaft are a kind of their own
    const auto id = ParseChannel(c.name);
    return std::pair(id->kind, id->row().scope == ChannelScope::kDirection && id->index == 2);
  };
  const auto against = [&](const GateColumn& a, const GateColumn& b) {  // a's data, b's prediction
    std::vector<double> predicted = b.column.predicted;
    for (double& p : predicted) p *= b.floor / a.floor;
    return ErrorBesideZero(a, predicted, MostZero(model, a.name));
  };
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = i + 1; j < columns.size(); ++j) {
      GateColumn &a = columns[i], &b = columns[j];
      if (a.explained || b.explained) continue;
      const double own_a = against(a, a), own_b = against(b, b), before = std::hypot(own_a, own_b);
      if (std::min(own_a, own_b) < 0.7 * kGrossError || before < 1.5 * kGrossError) continue;
      const double after = std::hypot(against(a, b), against(b, a));
      // columns of different kinds: each must fit the other's prediction far better
      if (after > (kind(a) == kind(b) ? 0.35 : 0.1) * before) continue;
      DataFault f = FaultOf(r, a.name, "swap", after / before);
      f.with = b.name;
      const auto column = [&](const std::string& name) {
        const auto it = r.sources.find(name);
        return it == r.sources.end() ? name : it->second.column;
      };
      f.mend = fmt::format("channels = {{ \"{}\" = \"{}\", \"{}\" = \"{}\" }}", a.name,
                           column(b.name), b.name, column(a.name));
      out.push_back(f);
      a.explained = b.explained = true;
    }
}

}  // namespace ambrig
