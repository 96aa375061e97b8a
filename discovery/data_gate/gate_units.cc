// Units and signs: what a factor brings back to the model.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"

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
      {1 / 0.0254, 0.15, 0.9, true},
      {0.0254, 0.15, 0.9, true},
      {2, 0.08, 0.95, true},
      {0.5, 0.08, 0.95, true},
      {std::sqrt(2.0), 0.05, 0.99, true},
      {std::sqrt(0.5), 0.05, 0.99, true},
  };
  return kAll;
}

constexpr double kMostGain = 1.6;  // that a sensor of the rig may have, or one over it
constexpr double kLikeOthers = 2, kMostLeft = 0.25;
constexpr double kOtherFactor = 0.2;  // logarithm of the ratio of two factors that are not the same
constexpr double kFarLess = 0.3;      // of the error that another factor leaves
constexpr double kLeftOfLevel = 0.05;  // a level is one number: it has to fit

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

/// A column that stands at a level and hardly moves (the bus, a clamped shaft): its movement is
/// noise and has no correlation with the prediction, but the level itself shows the factor, where
/// it is far beyond any `zero` [SI]. `movement`: the most that it may move, of its level.
bool LevelTells(const GateColumn& c, double zero, double movement) {
  constexpr double kFarFromZero = 6 * kGrossError;  // floors
  return c.match.predicted_rms > std::max(kFarFromZero, 2 * zero / c.floor) &&
         c.match.predicted_move < movement * c.match.predicted_rms &&
         c.match.measured_move < movement * c.match.measured_rms;
}

/// What is known of a column and of those beside it.
struct Suspect {
  const GateColumn& column;
  double error;  // beside a zero of the sensor [floors]
  Others others;
  bool level;                            // its level tells
  bool borne_out;                        // the other column of its coil shows the same
  std::vector<const GateColumn*> cells;  // the other load cells of its bearing, of a load cell
};

/// The other load cells of the bearing, where `of` is one.
std::vector<const GateColumn*> OtherCells(const std::vector<GateColumn>& columns,
                                          const GateColumn& of) {
  std::vector<const GateColumn*> out;
  const auto id = ParseChannel(of.name);
  if (!id || id->kind != ChannelKind::kLoadCell) return out;
  for (const GateColumn& c : columns) {
    const auto other = ParseChannel(c.name);
    if (&c != &of && other && other->kind == id->kind && other->plane == id->plane)
      out.push_back(&c);
  }
  return out;
}

/// Nothing where a fault was found already, or where the error is not gross.
std::optional<Suspect> SuspectOf(const CaseModel& model, const std::vector<GateColumn>& columns,
                                 const GateColumn& c) {
  if (c.explained || c.answered) return {};
  const double zero = MostZero(model, c.name), error = ErrorBesideZero(c, c.column.predicted, zero);
  if (error < kGrossError) return {};
  return Suspect{c,
                 error,
                 OthersOf(columns, c),
                 LevelTells(c, zero, 0.05),
                 BorneOut(columns, c),
                 OtherCells(columns, c)};
}

/// Least squares of measured about predicted, level and movement together.
double WholeGain(const MatchedColumn& c) {
  double mp = 0, pp = 0;
  for (std::size_t k = 0; k < c.size(); ++k)
    if (c.ok[k]) mp += c.measured[k] * c.predicted[k], pp += c.predicted[k] * c.predicted[k];
  return pp > 0 ? mp / pp : 0;
}

/// Whether another factor leaves far less than the listed one, which then only comes near.
bool OnlyNear(const Mistake& m, double rest, const Suspect& s) {
  const double gain = WholeGain(s.column.column);
  return gain > 0 && std::abs(std::log(gain / m.factor)) > kOtherFactor &&
         Left(s.column, gain, s.error) < kFarLess * rest;
}

/// Whether a cause in the machine may have made such forces: the other load cell of the bearing
/// errs too, and the factor is not one that both show and that no currents or gaps make.
bool ForcesDiffer(double factor, const Suspect& s) {
  constexpr double kOfMachine = 2.5, kSame = 0.1;
  return std::ranges::any_of(s.cells, [&](const GateColumn* other) {
    if (other->match.error <= kAlone * s.error) return false;
    const double gain = WholeGain(other->column);
    const bool same = gain > 0 && std::abs(std::log(gain / factor)) < kSame;
    return !same || std::max(factor, 1 / factor) < kOfMachine;
  });
}

/// Whether the machine itself may make such a factor: a coil whose set-point shows it too carries
/// that current; the zero of a sensor makes any factor below three of a position that is held;
/// forces differ in both directions, which no other column shows.
bool MachineMakes(double factor, const Suspect& s) {
  constexpr double kOfHeld = 3;
  if (s.borne_out) return true;
  if (s.level && IsOfKind(s.column.name, ChannelKind::kReading)) return factor < kOfHeld;
  return ForcesDiffer(factor, s);
}

/// The share of the error that this mistake leaves; nothing where it is not believed.
std::optional<double> LeftBy(const Mistake& m, const Suspect& s) {
  const GateColumn& c = s.column;
  if ((m.alone || m.correlation > 0) && MachineMakes(m.factor, s)) return {};
  const double rest = Left(c, m.factor, s.error);
  // An effect in the rig leaves an error in every column: of one that stands alone no less is asked
  // than of those.
  const double usual = m.alone ? kLikeOthers * s.others.error / s.error : 0;
  if (rest > std::max(m.left, std::min(usual, kMostLeft)) || !NoiseTells(c, m.factor)) return {};
  if (s.level ? m.correlation > 0 && rest > kLeftOfLevel : c.match.correlation < m.correlation)
    return {};
  // divided by the factor the column must still show what the model expects, its noise at least:
  // a movement that the model lacks is no unit
  if (c.match.measured_rms / m.factor < 0.3 * std::max(1.0, c.match.predicted_rms)) return {};
  if (m.correlation > 0 && OnlyNear(m, rest, s)) return {};
  if (m.alone && (s.error < 2 * kGrossError || s.others.error > kAlone * s.error)) return {};
  return rest;
}

/// The share of the error that a factor leaves which no list holds and no sensor has.
std::optional<double> LeftByAny(double factor, double correlation, const Suspect& s) {
  if (factor <= 0 || std::abs(std::log(factor)) < std::log(kMostGain)) return {};
  return LeftBy({factor, 0.08, correlation, true}, s);
}

/// A factor, and the share of the error that it leaves.
struct FoundFactor {
  double factor, left;
};

/// The power of ten that a gain is within one percent; the gain itself where it is none.
double PowerOfTenNear(double gain) {
  if (gain <= 0) return gain;
  const double power = std::pow(10.0, std::round(std::log10(gain)));
  return std::abs(gain / power - 1) < 0.01 ? power : gain;
}

/// The mistake of the list that leaves least, or any factor of the movement where none is believed
/// or where it leaves far less: a prefix asks for no shape, and beside a factor of 1e4 it leaves
/// little as well.
std::optional<FoundFactor> BestFactor(const Suspect& s) {
  std::optional<FoundFactor> best;
  for (const Mistake& m : Mistakes())
    if (const auto rest = LeftBy(m, s); rest && (!best || *rest < best->left))
      best = {m.factor, *rest};
  if (s.level) return best;
  const double gain = s.column.match.gain;
  if (best && (gain <= 0 || std::abs(std::log(gain / best->factor)) < kOtherFactor)) return best;
  const double factor = PowerOfTenNear(gain);
  if (const auto rest = LeftByAny(factor, 0.98, s);
      rest && (!best || *rest < kFarLess * best->left))
    best = {factor, *rest};
  return best;
}

void TellFactor(const CaseRecord& r, GateColumn& c, const FoundFactor& found,
                std::vector<DataFault>& out) {
  out.push_back(FactorFault(r, c.name, found.factor, found.left));
  c.explained = true;
}

}  // namespace

std::string UnitLine(const CaseRecord& r, const std::string& channel, double factor) {
  const auto it = r.sources.find(channel);
  const auto id = ParseChannel(channel);
  const ColumnSource source = it == r.sources.end()
                                  ? ColumnSource{channel, id ? std::string(id->row().unit) : "", 1}
                                  : it->second;
  const double right = source.factor / factor;  // SI per number in the file
  static constexpr std::array<std::pair<double, const char*>, 4> kPrefixes = {
      {{1, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e3, "k"}}};
  if (source.si == "m" && std::abs(right / 1e-9 - 1) < 1e-6)
    return fmt::format("channels.\"{}\" = {{ column = \"{}\", unit = \"nm\" }}", channel,
                       source.column);
  for (const auto& [size, prefix] : kPrefixes)
    if (std::abs(right / size - 1) < 1e-6)
      return fmt::format("channels.\"{}\" = {{ column = \"{}\", unit = \"{}{}\" }}", channel,
                         source.column, prefix, source.si);
  if (source.si == "rad" && std::abs(right / (kPi / 180) - 1) < 1e-6)
    return fmt::format("channels.\"{}\" = {{ column = \"{}\", unit = \"deg\" }}", channel,
                       source.column);
  if (source.si == "rad/s")
    for (const auto& [size, unit] : {std::pair{kRpm, "rpm"}, {kTurn, "Hz"}, {kPi / 180, "deg/s"}})
      if (std::abs(right / size - 1) < 1e-6)
        return fmt::format("channels.\"{}\" = {{ column = \"{}\", unit = \"{}\" }}", channel,
                           source.column, unit);
  return fmt::format("channels.\"{}\" = {{ column = \"{}\", unit = \"{}\", gain = {:.9g} }}",
                     channel, source.column, source.si, source.factor / factor);
}

void CheckUnits(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  for (GateColumn& c : columns) {
    const std::optional<Suspect> suspect = SuspectOf(model, columns, c);
    if (!suspect) continue;
    const double opposite = Left(c, -1, suspect->error);
    const bool opposite_level = LevelTells(c, MostZero(model, c.name), 0.3) && opposite < 0.1;
    if (const auto found = BestFactor(*suspect))
      TellFactor(r, c, *found, out);
    else if (opposite_level || (c.match.correlation < -0.7 && opposite < 0.3))
      TellFactor(r, c, {-1, opposite}, out);
  }
}

void CheckLevelFactors(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                       std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  for (GateColumn& c : columns) {
    const bool current = IsOfKind(c.name, ChannelKind::kCoilCurrent),
               bus = IsOfKind(c.name, ChannelKind::kBus);
    if (!current && !bus) continue;
    const std::optional<Suspect> suspect = SuspectOf(model, columns, c);
    if (!suspect) continue;
    const bool others_tell =
        current ? suspect->others.bearing : suspect->others.error < kGrossError;
    if (!others_tell) continue;
    const double gain = WholeGain(c.column);
    if (const auto left = LeftByAny(gain, 0, *suspect)) TellFactor(r, c, {gain, *left}, out);
  }
}

}  // namespace ambrig
