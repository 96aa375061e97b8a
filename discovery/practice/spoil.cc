#include "discovery/practice/spoil.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "core/record/channels.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/data_gate/data_gate.h"

namespace ambrig {

namespace {

using Samples = std::vector<double>;

// usual amounts
constexpr double kTooLarge = 1000;
constexpr double kLate = 0.02, kLateInstrument = 4e-3;  // [s]
constexpr double kLost = 0.08, kFrozen = 0.15;          // of the record
constexpr double kClipped = 0.6;                        // of the largest value
constexpr double kOutOfRange = 1e4;
constexpr double kTimesUsualStep = 20;  // from row to row: noise reaches four of them

double Movement(const Samples& y) {
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  return y.empty() ? 0 : *high - *low;
}

/// Median difference from row to row, of rows that do not repeat the one before: a record may be
/// faster than the controller that takes the readings.
double UsualStep(const Samples& y) {
  Samples steps;
  for (std::size_t k = 1; k < y.size(); ++k)
    if (y[k] != y[k - 1]) steps.push_back(std::abs(y[k] - y[k - 1]));
  return steps.empty() ? 0 : MedianOf(std::move(steps));
}

/// Whether a column shows more than noise about zero: what is done to that cannot be seen, and does
/// no harm.
bool ShowsSomething(const Samples& y) {
  if (y.size() < 2) return false;
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  return std::max(*high, -*low) > kTimesUsualStep * UsualStep(y);
}

Channel& Moving(CaseRecord& r, const std::string& wanted, std::uint64_t seed) {
  std::vector<Channel*> all;
  for (Channel& c : r.data.channels) {
    if (!wanted.empty() && c.name == wanted) return c;
    const bool reading = IsOfKind(c.name, ChannelKind::kReading),
               current = IsOfKind(c.name, ChannelKind::kCoilCurrent);
    if ((reading || current) && ShowsSomething(c.samples)) all.push_back(&c);
  }
  if (!wanted.empty() || all.empty())
    throw InputError(fmt::format("{}: no such column in {}", wanted, r.data_file));
  return *all[static_cast<std::size_t>(Uniform(seed, 303, 0) * static_cast<double>(all.size()))];
}

void Late(Samples& y, std::size_t rows) {
  if (rows + 1 >= y.size()) return;
  // Before the scenario the rig did what it does at its start: the first rows, backwards.
  const Samples earlier(y.begin() + 1, y.begin() + 1 + static_cast<std::ptrdiff_t>(rows));
  y.insert(y.begin(), earlier.rbegin(), earlier.rend());
  y.resize(y.size() - rows);
}

void Clip(Samples& y, double share) {
  const double top = share * *std::max_element(y.begin(), y.end()),
               low = share * *std::min_element(y.begin(), y.end());
  for (double& v : y) v = top > 0 ? std::min(v, top) : std::max(v, low);
}

Channel& NextOfKind(CaseRecord& r, const Channel& of) {
  const auto id = ParseChannel(of.name);
  Channel* best = nullptr;
  double most = 0;
  for (Channel& c : r.data.channels) {
    const auto other = ParseChannel(c.name);
    if (&c == &of || !id || !other || other->kind != id->kind || other->plane != id->plane)
      continue;
    double apart = 0;
    for (std::size_t k = 0; k < c.samples.size(); ++k)
      apart += std::pow(c.samples[k] - of.samples[k], 2);
    if (apart > most) most = apart, best = &c;
  }
  if (!best) throw InputError(of.name + ": has no column to be exchanged with");
  return *best;
}

std::string ExchangeData(Case& c, std::size_t record) {
  CaseRecord& r = c.records[record];
  for (std::size_t k = 0; k < c.records.size(); ++k) {
    CaseRecord& o = c.records[k];
    if (k == record || o.scenario.start != r.scenario.start || o.data.rate != r.data.rate ||
        o.data.rows() != r.data.rows())
      continue;
    std::swap(r.data, o.data);
    return "data exchanged with those of " + o.data_file;
  }
  throw InputError(r.data_file + ": no other record has as many rows at its rate");
}

}  // namespace

std::string Spoil(Case& c, std::size_t record, const Spoiling& what, std::uint64_t seed) {
  CaseRecord& r = c.records.at(record);
  const auto rows = r.data.rows();
  const auto amount = [&](double usual) { return what.amount > 0 ? what.amount : usual; };
  if (what.fault == "scenario") return ExchangeData(c, record);
  if (what.fault == "lag" || what.fault == "instrument") {
    const bool all = what.fault == "lag";
    // a burst may be shorter than that
    const auto late = std::min(
        static_cast<std::size_t>(std::lround(amount(all ? kLate : kLateInstrument) * r.data.rate)),
        2 * rows / 3);
    for (Channel& ch : r.data.channels)
      if (all || IsOfKind(ch.name, ChannelKind::kReading)) Late(ch.samples, late);
    return fmt::format("{}: all {} {:.4g} s late", r.data_file, all ? "columns" : "positions",
                       static_cast<double>(late) / r.data.rate);
  }
  if (what.fault == "lost") {
    const auto from = static_cast<std::ptrdiff_t>(0.45 * static_cast<double>(rows)),
               count = static_cast<std::ptrdiff_t>(amount(kLost) * static_cast<double>(rows));
    for (Channel& ch : r.data.channels)
      ch.samples.erase(ch.samples.begin() + from, ch.samples.begin() + from + count);
    for (ChannelQuality& q : r.quality) q.ok.resize(rows - static_cast<std::size_t>(count), 1);
    return fmt::format("{}: {} rows lost from {:.4g} s on", r.data_file, count,
                       r.data.TimeAt(static_cast<std::size_t>(from)));
  }
  Channel& ch = Moving(r, what.channel, seed);
  Samples& y = ch.samples;
  if (what.fault == "unit") {
    for (double& v : y) v *= amount(kTooLarge);
  } else if (what.fault == "sign") {
    for (double& v : y) v = -v;
  } else if (what.fault == "swap") {
    Channel& other = NextOfKind(r, ch);
    std::swap(y, other.samples);
    return fmt::format("{}: {} and {} exchanged", r.data_file, ch.name, other.name);
  } else if (what.fault == "clip") {
    Clip(y, amount(kClipped));
  } else if (what.fault == "freeze") {
    const auto from = static_cast<std::size_t>(0.4 * static_cast<double>(rows));
    for (std::size_t k = from;
         k < from + static_cast<std::size_t>(amount(kFrozen) * static_cast<double>(rows)); ++k)
      y[k] = y[from];
  } else if (what.fault == "range") {
    y[rows / 3] = amount(kOutOfRange) * (std::abs(y[rows / 3]) + Movement(y));
  } else {
    throw InputError(
        fmt::format("{}: no such mistake, allowed: unit, sign, swap, lag, instrument, clip, "
                    "freeze, lost, range, scenario",
                    what.fault));
  }
  return fmt::format("{}: {} of {}", r.data_file, what.fault, ch.name);
}

bool ShowsMistake(const CaseRecord& before, const CaseRecord& after) {
  for (std::size_t ch = 0; ch < before.data.channels.size(); ++ch) {
    const Samples &was = before.data.channels[ch].samples, &is = after.data.channels[ch].samples;
    const std::string& name = before.data.channels[ch].name;
    // they follow the scenario, whatever else happens
    if (IsOfKind(name, ChannelKind::kAngle) || IsOfKind(name, ChannelKind::kSpeed)) continue;
    double square = 0;
    for (std::size_t k = 0; k < std::min(was.size(), is.size()); ++k)
      square += std::pow(is[k] - was[k], 2);
    if (std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, was.size()))) >
        kTimesUsualStep * UsualStep(was))
      return true;
  }
  return false;
}

}  // namespace ambrig
