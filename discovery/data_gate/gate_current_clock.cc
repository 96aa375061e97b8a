// The clock of coil currents beside that of their own set-points: an amplifier follows its
// set-point with the same delay in all records, whatever acts on the rotor.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/record/channels.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_shifts.h"

namespace ambrig {

namespace {

constexpr double kLeastSetPoint = 0.003;  // of the converter's range: the movement that tells
constexpr double kFollowsWithin = 0.5;    // most error of a coil that follows, of the movement
constexpr double kLateLeaves = 0.4;       // of the error that undoing a wrong clock may leave
constexpr double kLeastClock = 1e-3;      // [s]: amplifiers delay, too
constexpr double kLongestClock = 0.02;    // [s]
constexpr double kClockStep = 2.5e-4;     // [s] of the first search

/// How a coil follows its set-point in one record.
struct Following {
  const CaseRecord* record = nullptr;
  double error = 0;  // rms of current minus set-point [A]
  double least = 0;  // that of the set-point `late` rows later, where it is least
  long late = 0;

  double seconds() const { return static_cast<double>(late) / record->data.rate; }
  bool on_time() const { return std::abs(seconds()) < kLeastClock; }
};

/// Takes the mean of the values that count off.
void Center(std::vector<double>& values, const std::vector<char>& ok) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (ok[k]) sum += values[k], n += 1;
  for (double& v : values) v -= n > 0 ? sum / n : 0;
}

MatchedColumn Movements(const Channel& current, const Channel& set_point) {
  MatchedColumn out{current.samples, set_point.samples, std::vector<char>(current.samples.size())};
  for (std::size_t k = 0; k < out.size(); ++k)
    out.ok[k] = std::isfinite(out.measured[k]) && std::isfinite(out.predicted[k]) ? 1 : 0;
  Center(out.measured, out.ok);
  Center(out.predicted, out.ok);
  for (std::size_t k = 0; k < out.size(); ++k)
    if (!out.ok[k]) out.measured[k] = out.predicted[k] = 0;
  return out;
}

Following FollowingOf(double rate, const MatchedColumn& c) {
  Following out{nullptr, MatchOf(c).error, kInfinity, 0};
  const auto seek = [&](long first, long last, long step) {
    for (long late = first; late <= last; late += step)
      if (const double error = MatchLater(c, late, 0).error; error < out.least)
        out.least = error, out.late = late;
  };
  const long longest = std::min(std::lround(kLongestClock * rate), static_cast<long>(c.size() / 4));
  const long step = std::max(1L, std::lround(kClockStep * rate));
  seek(-longest, longest, step);
  seek(out.late - step + 1, out.late + step - 1, 1);
  return out;
}

/// Whether the model's coil comes as late in this record: where its voltage ends, it does.
bool ComesAsLate(const CaseModel& model, const Hypothesis& h, const std::string& current,
                 const Following& f) {
  constexpr double kAsLate = 0.5;
  auto id = ParseChannel(current);
  id->kind = ChannelKind::kSetPoint;
  const auto& records = model.data().records;
  const auto number = static_cast<std::size_t>(f.record - records.data());
  const Record run = model.Simulated(h, number, false, 1, {current, id->name()});
  const Channel *follower = run.Find(current), *followed = run.Find(id->name());
  if (!follower || !followed) return false;
  const double seconds =
      static_cast<double>(FollowingOf(run.rate, Movements(*follower, *followed)).late) / run.rate;
  return seconds / f.seconds() > kAsLate;
}

/// By coil: the records whose set-points tell how it follows.
std::map<std::string, std::vector<Following>> FollowingsOf(const CaseModel& model) {
  std::map<std::string, std::vector<Following>> out;
  const double least = kLeastSetPoint * model.data().rig.amplifier.adc_range;
  for (const CaseRecord& r : model.data().records) {
    if (!OverTime(r) || r.imposed != Imposed::kNothing || !r.scenario.faults.empty()) continue;
    for (const Channel& current : r.data.channels) {
      auto id = ParseChannel(current.name);
      if (!id || id->kind != ChannelKind::kCoilCurrent) continue;
      id->kind = ChannelKind::kSetPoint;
      const Channel* set_point = r.data.Find(id->name());
      if (!set_point || set_point->samples.size() != current.samples.size()) continue;
      const MatchedColumn moves = Movements(current, *set_point);
      const double move = MatchOf(moves).predicted_move;
      if (move < least) continue;
      Following f = FollowingOf(r.data.rate, moves);
      f.record = &r;
      if (f.least < kFollowsWithin * move) out[current.name].push_back(f);
    }
  }
  return out;
}

}  // namespace

void CheckCurrentClocks(const CaseModel& model, const Hypothesis& h, std::vector<DataFault>& out) {
  for (const auto& [channel, records] : FollowingsOf(model)) {
    std::vector<double> delays;  // of the amplifier itself [s]
    for (const Following& f : records)
      if (f.on_time()) delays.push_back(f.seconds());
    if (delays.empty()) continue;
    const double delay = MedianOf(delays);
    for (const Following& f : records)
      if (!f.on_time() && f.least < kLateLeaves * f.error && !ComesAsLate(model, h, channel, f))
        out.push_back(
            TimeFault(*f.record, channel, {f.seconds() - delay, 0, f.least / f.error, true}));
  }
}

}  // namespace ambrig
