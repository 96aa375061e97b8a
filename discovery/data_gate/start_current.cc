#include "discovery/data_gate/start_current.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kStartFloors = 5;     // of one of the first rows
constexpr std::size_t kFirstRows = 3;  // the first one may hold a reading from before the start
constexpr double kTimeConstants = 5;   // of the coil and its regulator: e^-5 of it is left
constexpr double kLeftOfStart = 0.3;   // of the first error, at the most, behind that
constexpr std::size_t kRowsOfMean = 5;

/// Of the slowest coil of a bearing, L/R, and of its regulator's integral action, kp/ki [s].
double SlowestConstant(const RigParameters& rig, const BearingParameters& b) {
  const AmplifierParameters& a = rig.amplifier;
  return LargestInductance(b) / CoilResistance(b) + (a.ki > 0 ? a.kp / a.ki : 0);
}

/// The largest error of the first rows that count; `row` = count: there is none.
struct StartError {
  std::size_t row = 0;
  double error = 0;
};

StartError StartErrorOf(const CaseModel& model, const std::vector<double>& predicted,
                        const Target& t) {
  StartError out{t.count, 0};
  std::size_t seen = 0;
  for (std::size_t k = 0; k < t.count && seen < kFirstRows; ++k) {
    if (!model.ok()[t.first + k]) continue;
    ++seen;
    const double error = model.measured()[t.first + k] - predicted[t.first + k];
    if (out.row == t.count || std::abs(error) > std::abs(out.error)) out = {k, error};
  }
  return out;
}

/// Mean error of the rows from this sample on.
double MeanErrorFrom(const CaseModel& model, const std::vector<double>& predicted, const Target& t,
                     std::size_t sample) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < t.count && n < kRowsOfMean; ++k) {
    const std::size_t row = t.first + k;
    if (!model.ok()[row] || model.sample(row) < sample) continue;
    sum += model.measured()[row] - predicted[row];
    n += 1;
  }
  return n > 0 ? sum / n : kInfinity;
}

}  // namespace

std::vector<UnstatedStart> UnstatedStartsOf(const CaseModel& model,
                                            const std::vector<double>& predicted) {
  std::vector<UnstatedStart> out;
  double farthest = 0;  // [floors], of the record that is last in `out`
  for (const Target& t : model.targets()) {
    const CaseRecord& r = model.data().records[t.record];
    const auto id = ParseChannel(r.data.channels[t.channel].name);
    if (!OverTime(r) || r.scenario.start != StartState::kClamped || !id ||
        id->kind != ChannelKind::kCoilCurrent || !r.scenario.start_current.empty())
      continue;
    const BearingParameters* b = model.data().rig.Find(id->plane);
    const StartError first = StartErrorOf(model, predicted, t);
    if (!b || first.row == t.count || std::abs(first.error) <= kStartFloors * t.floor) continue;
    const double settled = kTimeConstants * SlowestConstant(model.data().rig, *b);
    const auto sample =
        static_cast<std::size_t>(std::max(0.0, std::ceil((settled - r.data.start) * r.data.rate)));
    if (std::abs(MeanErrorFrom(model, predicted, t, sample)) > kLeftOfStart * std::abs(first.error))
      continue;
    const double floors = std::abs(first.error) / t.floor;
    const bool known = !out.empty() && out.back().record == t.record;
    if (known && floors <= farthest) continue;
    if (!known) out.emplace_back();
    farthest = floors;
    const std::size_t row = t.first + first.row;
    out.back() = {t.record, r.data.channels[t.channel].name, model.measured()[row], predicted[row],
                  settled};
  }
  return out;
}

std::vector<SampleSpan> SpansOf(const CaseModel& model, const std::vector<UnstatedStart>& starts) {
  std::vector<SampleSpan> out;
  for (const UnstatedStart& s : starts) {
    const Record& data = model.data().records[s.record].data;
    const double rows = (s.settled - data.start) * data.rate;
    if (rows >= 1) out.push_back({s.record, 0, static_cast<std::size_t>(rows)});
  }
  return out;
}

std::vector<std::string> StartRemarks(const Case& c, const std::vector<UnstatedStart>& starts) {
  std::vector<std::string> out;
  for (const UnstatedStart& s : starts)
    out.push_back(fmt::format(
        "{}: {} begins at {:.3g} A, where {:.3g} A are commanded: what went before is not known, "
        "the first "
        "{:.2g} ms are left out (a scenario states it: [start] current)",
        c.records[s.record].data_file, s.channel, s.measured, s.predicted, 1e3 * s.settled));
  return out;
}

}  // namespace ambrig
