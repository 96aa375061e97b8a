// The measured speed beside the profile of its scenario: its unit, its clock, and stretches that
// stand still.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/data/held_values.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_shifts.h"

namespace ambrig {

namespace {

// A speed that is late by a clock has the profile's corners, one that lags behind by its drive has
// not: of a lag of at least the first share of the largest speed a drive leaves a tenth of the
// error after the best shift.
constexpr double kLateSpeed = 0.02, kSharpSpeed = 0.03;

/// The measured speed beside the scenario's profile; no rows where the speed is free or not
/// recorded.
MatchedColumn SpeedColumn(const CaseRecord& r) {
  MatchedColumn c;
  const Channel* omega = Find(r.data, {ChannelKind::kSpeed});
  if (!omega || r.scenario.speed_free_from < r.scenario.duration) return c;
  for (std::size_t k = 0; k < omega->samples.size(); ++k) {
    const double y = omega->samples[k];
    c.ok.push_back(std::isfinite(y) ? 1 : 0);
    c.measured.push_back(std::isfinite(y) ? y : 0);
    c.predicted.push_back(r.scenario.speed.Speed(r.data.TimeAt(k)));
  }
  return c;
}

double LargestOf(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

struct SpeedFactor {
  double factor = 1, left = 1;  // share of the error
};

/// The factor of a speed or an angle that leaves the least: one of a unit, or of a profile that
/// moves any other if it leaves hardly anything.
std::optional<SpeedFactor> FactorOfSpeed(const MatchedColumn& c, double before) {
  constexpr double kOfUnit = 0.1, kOfAny = 0.02, kFarLess = 0.3;
  constexpr double kMoving = 0.2;  // of the profile's rms
  constexpr double kNear = 0.02, kMostOfDrive = 1.6;
  const auto left = [&](double factor) {
    return ErrorAgainst(c.measured, c.predicted, c.ok, factor) / std::abs(factor) / before;
  };
  SpeedFactor best{1, kOfUnit};
  for (const double factor :
       {1 / kRpm, kRpm, 1 / kTurn, kTurn, 180 / kPi, kPi / 180, 60.0, 1 / 60.0, -1.0})
    if (left(factor) < best.left) best = {factor, left(factor)};
  const Match m = MatchOf(c);
  // a standing speed of another size is of another scenario
  if (m.predicted_move < kMoving * m.predicted_rms || m.gain == 0)
    return best.factor == 1 ? std::nullopt : std::optional(best);
  const bool other = best.factor == 1 || std::abs(m.gain / best.factor - 1) > kNear;
  const bool far = std::abs(std::log(std::abs(m.gain))) > std::log(kMostOfDrive);
  const double any = left(m.gain);
  if (other && far && any < std::min(kOfAny, kFarLess * best.left)) best = {m.gain, any};
  return best.factor == 1 ? std::nullopt : std::optional(best);
}

/// The longest stretch in which the speed stands while its profile moves on, and but for which it
/// follows the profile.
HeldStretch StandingSpeed(const CaseRecord& r, const MatchedColumn& c) {
  constexpr std::size_t kLeastStretch = 20, kTimesUsualHold = 15;  // rows
  constexpr double kLeast = 1, kOfMost = 0.02;                     // [rad/s], of the largest speed
  constexpr double kOutside = 0.3;  // of the error within the stretch
  const std::vector<double>& y = Find(r.data, {ChannelKind::kSpeed})->samples;
  HeldStretch longest;
  for (const HeldStretch& s :
       HeldStretches(y, std::max(kLeastStretch, kTimesUsualHold * UsualHold(y)))) {
    const auto first = c.predicted.begin() + static_cast<std::ptrdiff_t>(s.first);
    const auto [low, high] =
        std::minmax_element(first, first + static_cast<std::ptrdiff_t>(s.count));
    if (*high - *low < kLeast + kOfMost * LargestOf(c.predicted) || s.count < longest.count)
      continue;
    MatchedColumn outside = c, within = c;
    for (std::size_t k = 0; k < c.size(); ++k)
      (k >= s.first && k < s.first + s.count ? outside : within).ok[k] = 0;
    if (MatchOf(outside).error < kOutside * MatchOf(within).error) longest = s;
  }
  return longest;
}

}  // namespace

void CheckSpeedTime(const CaseModel& model, std::size_t record,
                    const std::vector<GateColumn>& columns, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const bool told = std::any_of(out.begin(), out.end(), [&](const DataFault& f) {
    return f.record == r.data_file && (f.channel.empty() || f.channel == "omega");
  });
  if (told) return;
  GateColumn speed{"omega", SpeedColumn(r), {}, 1, false};
  if (speed.column.size() == 0) return;
  speed.match = MatchOf(speed.column);
  if (speed.match.predicted_move == 0 ||
      speed.match.error < kLateSpeed * LargestOf(speed.column.predicted))
    return;
  const FoundShift s = ShiftOf({&speed}, r.data.rate);
  if (std::abs(s.late) < kLeastColumn || s.left > kSharpSpeed) return;
  out.push_back(TimeFault(r, MovingColumns(columns, 1).empty() ? "" : "omega", s));
}

void CheckSpeed(const CaseModel& model, std::size_t record, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const MatchedColumn c = SpeedColumn(r);
  if (c.size() == 0) return;
  if (const HeldStretch s = StandingSpeed(r, c); s.count > 0) {
    TellHeld(r, "omega", s, out);
    return;
  }
  const double most = LargestOf(c.predicted);
  const double before = ErrorAgainst(c.measured, c.predicted, c.ok);
  if (before < 5 + 0.05 * most) return;
  constexpr double kSpeedIsKnown = 0.98;  // probability: a profile is prescribed
  if (const auto found = FactorOfSpeed(c, before)) {
    out.push_back(FactorFault(r, "omega", found->factor, found->left));
    out.back().probability = kSpeedIsKnown;
    return;
  }
  DataFault f;
  f.record = r.data_file;
  f.fault = "scenario";
  f.probability = kSpeedIsKnown;
  TellScenario(f, out);
}

namespace {

/// An angle that starts again after every turn, in radians, degrees or turns, without its jumps.
std::vector<double> WithoutTurns(const std::vector<double>& y) {
  constexpr double kWholeTurn = 0.05, kJump = 0.5;
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  std::vector<double> out = y;
  for (const double turn : {kTurn, 360.0, 1.0}) {
    if (std::abs((*high - *low) / turn - 1) > kWholeTurn) continue;
    for (std::size_t k = 1; k < y.size(); ++k) {
      const double step = y[k] - y[k - 1];
      out[k] = out[k - 1] + step - (std::abs(step) > kJump * turn ? std::copysign(turn, step) : 0);
    }
  }
  return out;
}

/// The measured angle beside that of the profile, both about their means: where an encoder counts
/// from says nothing.
MatchedColumn AngleColumn(const CaseRecord& r) {
  MatchedColumn c;
  const Channel* theta = Find(r.data, {ChannelKind::kAngle});
  if (!theta || r.scenario.speed_free_from < r.scenario.duration ||
      !std::ranges::all_of(theta->samples, [](double v) { return std::isfinite(v); }))
    return c;
  c.measured = WithoutTurns(theta->samples);
  c.ok.assign(c.measured.size(), 1);
  double measured = 0, predicted = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    c.predicted.push_back(r.scenario.speed.Angle(r.data.TimeAt(k)));
    measured += c.measured[k] / static_cast<double>(c.size());
    predicted += c.predicted[k] / static_cast<double>(c.size());
  }
  for (double& v : c.measured) v -= measured;
  for (double& v : c.predicted) v -= predicted;
  return c;
}

}  // namespace

void CheckAngle(const CaseModel& model, std::size_t record, std::vector<DataFault>& out) {
  constexpr double kLeastAngle = 1, kGrossAngle = 0.3;  // [rad], of the movement
  const CaseRecord& r = model.data().records[record];
  // a wrong speed has been told of
  if (std::ranges::any_of(
          out, [](const DataFault& f) { return f.channel.empty() || f.channel == "omega"; }))
    return;
  const MatchedColumn c = AngleColumn(r);
  if (c.size() == 0) return;
  const Match m = MatchOf(c);
  if (m.predicted_move < kLeastAngle || m.error < kGrossAngle * m.predicted_move) return;
  const auto found = FactorOfSpeed(c, m.error);
  if (!found) return;
  out.push_back(FactorFault(r, "theta", found->factor, found->left));
}

}  // namespace ambrig
