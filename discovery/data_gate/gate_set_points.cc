#include "discovery/data_gate/gate_set_points.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/record/channels.h"

namespace ambrig {

namespace {

constexpr double kFrozenSetPoint = 0.08;  // of the rows

/// The bearing's other set-points.
std::vector<const Channel*> OtherSetPoints(const CaseRecord& r, const std::string& channel) {
  const auto id = ParseChannel(channel);
  std::vector<const Channel*> out;
  for (const Channel& c : r.data.channels) {
    const auto other = ParseChannel(c.name);
    if (other && c.name != channel && other->kind == id->kind && other->plane == id->plane)
      out.push_back(&c);
  }
  return out;
}

/// Whether another set-point of the bearing stands still for half of these rows too, or there is
/// none: a force at its limit holds the set-points of an axis together, a logger one column.
bool HeldTogether(const CaseRecord& r, const std::string& channel, const HeldStretch& s) {
  const std::vector<const Channel*> others = OtherSetPoints(r, channel);
  return others.empty() || std::ranges::any_of(others, [&](const Channel* c) {
           std::size_t held = 0;
           for (std::size_t k = s.first + 1; k < s.first + s.count && k < c->samples.size(); ++k)
             held += c->samples[k] == c->samples[k - 1] ? 1 : 0;
           return 2 * held >= s.count;
         });
}

}  // namespace

std::size_t ClippedSetPointRows(const CaseModel& model, const CaseRecord& r, const GateColumn& c,
                                const std::vector<double>& y, double extreme) {
  constexpr double kNearLimit = 0.02;     // of the largest current
  constexpr double kTogether = 0.3;       // of the rows
  constexpr std::size_t kMoreOften = 10;  // than any other value
  const double i_max = model.data().rig.amplifier.i_max;
  if (std::abs(extreme) < kNearLimit * i_max || std::abs(extreme) > (1 - kNearLimit) * i_max)
    return 0;
  std::map<double, std::size_t> times;
  for (const double v : y)
    if (std::isfinite(v)) ++times[v];
  const std::size_t rows = times[extreme];
  for (const auto& [value, count] : times)
    if (value != extreme && kMoreOften * count > rows) return 0;
  const std::vector<const Channel*> others = OtherSetPoints(r, c.name);
  for (const Channel* other : others) {
    const std::vector<double>& of = other->samples;
    const auto [low, high] = std::minmax_element(of.begin(), of.end());
    std::size_t at_limit = 0;
    for (std::size_t k = 0; k < y.size(); ++k)
      at_limit += y[k] == extreme && (of[k] == *low || of[k] == *high);
    if (static_cast<double>(at_limit) > kTogether * static_cast<double>(rows)) return 0;
  }
  return others.empty() ? 0 : rows;
}

bool SetPointFroze(const CaseRecord& r, const GateColumn& c, const HeldStretch& s) {
  constexpr double kShortFreeze = 0.01;  // of the rows
  const auto rows = static_cast<double>(c.column.size()), count = static_cast<double>(s.count);
  // a force at its limit holds single set-points for some rows
  if (count >= kFrozenSetPoint * rows) return true;
  const auto first = c.column.predicted.begin() + static_cast<std::ptrdiff_t>(s.first);
  const auto [low, high] = std::minmax_element(first, first + static_cast<std::ptrdiff_t>(s.count));
  return count >= kShortFreeze * rows && *high - *low > 2 * kBeyondFloors &&
         !HeldTogether(r, c.name, s);
}

}  // namespace ambrig
