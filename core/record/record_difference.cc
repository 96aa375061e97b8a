#include "core/record/record_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/base/toml_checked.h"

namespace ambrig {

namespace {

bool Fits(const std::string& name, const std::string& pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return name == pattern;
  const std::string head = pattern.substr(0, star), tail = pattern.substr(star + 1);
  return name.size() >= head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail);
}

bool SameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

/// The second record's channel as a function of the first's row number.
class Line {
 public:
  Line(const Record& a, const Record& b, const Channel& of_b)
      : samples_(of_b.samples),
        rows_per_row_(b.rate / a.rate),
        offset_((a.start - b.start) * b.rate) {}

  /// Place in b [rows] of row k of a; whole numbers where rounding alone keeps it from one.
  double Place(double k) const {
    const double p = offset_ + k * rows_per_row_, near = std::round(p);
    return std::abs(p - near) < 1e-6 ? near : p;
  }
  bool Holds(double place) const {
    return place >= 0 && place <= static_cast<double>(samples_.size()) - 1;
  }
  double At(double place) const {
    const double floor = std::floor(place);
    const auto k = static_cast<std::size_t>(floor);
    if (place == floor) return samples_[k];
    return samples_[k] + (place - floor) * (samples_[k + 1] - samples_[k]);
  }
  /// Least distance of `value` from the line over [place - span, place + span].
  double Distance(double value, double place, double span) const {
    const double last = static_cast<double>(samples_.size()) - 1;
    const double from = std::max(0.0, place - span), to = std::min(last, place + span);
    double lo = std::min(At(from), At(to)), hi = std::max(At(from), At(to));
    for (double p = std::ceil(from); p <= to; ++p) {
      lo = std::min(lo, samples_[static_cast<std::size_t>(p)]);
      hi = std::max(hi, samples_[static_cast<std::size_t>(p)]);
    }
    return value < lo ? lo - value : (value > hi ? value - hi : 0);
  }

 private:
  const std::vector<double>& samples_;
  double rows_per_row_, offset_;
};

double Largest(const std::vector<double>& samples) {
  double largest = 0;
  for (const double v : samples)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  return largest;
}

/// One row; true when it is beyond the tolerance.
bool CompareRow(double a, double place, const Line& line, double span, ChannelDifference& d,
                bool* bits) {
  const double b = line.At(place);
  if (SameBits(a, b)) return false;
  *bits = false;
  if (!std::isfinite(a) || !std::isfinite(b)) {
    d.verdict = ChannelVerdict::kNan;
    return true;
  }
  d.rms += (a - b) * (a - b);
  if (std::abs(a - b) > d.worst) d.worst = std::abs(a - b);
  if (span > 0 && !(line.Holds(place - span) && line.Holds(place + span))) return false;
  const double away = span > 0 ? line.Distance(a, place, span) : std::abs(a - b);
  return !(away <= d.allowed && (d.allowed > 0 || span > 0));
}

ChannelDifference CompareChannel(const Record& a, const Record& b, const Channel& ca,
                                 const Channel& cb, const ChannelTolerance& t) {
  ChannelDifference d;
  d.channel = ca.name;
  d.unit = ca.unit;
  if (!cb.unit.empty() && !ca.unit.empty() && ca.unit != cb.unit) {
    d.verdict = ChannelVerdict::kOtherUnit;
    d.first = a.start;
    return d;
  }
  d.allowed = t.absolute + t.relative * Largest(ca.samples);
  const Line line(a, b, cb);
  bool bits = true;
  for (std::size_t k = 0; k < ca.samples.size(); ++k) {
    const double place = line.Place(static_cast<double>(k)), before = d.worst;
    if (!line.Holds(place)) continue;
    ++d.rows;
    if (CompareRow(ca.samples[k], place, line, t.time * b.rate, d, &bits) && d.beyond++ == 0)
      d.first = a.TimeAt(k);
    if (d.worst > before) d.worst_at = a.TimeAt(k);
  }
  d.rms = d.rows > 0 ? std::sqrt(d.rms / static_cast<double>(d.rows)) : 0;
  if (d.verdict != ChannelVerdict::kNan)
    d.verdict = d.beyond > 0 ? ChannelVerdict::kDiffers
                             : (bits ? ChannelVerdict::kSame : ChannelVerdict::kWithin);
  return d;
}

std::string LengthProblem(const Record& a, const Record& b) {
  const double end_a = a.TimeAt(a.rows()), end_b = b.TimeAt(b.rows());
  const double row = 1.5 / std::min(a.rate, b.rate);
  if (std::abs(a.start - b.start) > row)
    return fmt::format("starts at {} s, was {} s", b.start, a.start);
  if (std::abs(end_a - end_b) > row)
    return fmt::format("ends at {:.6g} s, was {:.6g} s", end_b, end_a);
  return "";
}

ChannelTolerance ReadOne(const TomlTable& t) {
  ChannelTolerance out;
  out.absolute = Within(t, "absolute", 0, {"SI", 0, 1e12, "largest difference"});
  out.relative = Within(t, "relative", 0, {"-", 0, 10, "share of the channel's largest value"});
  out.time = Within(t, "time", 0, {"s", 0, 1e3, "how far a value may move in time"});
  t.RejectUnknownKeys();
  return out;
}

}  // namespace

ChannelTolerance RecordTolerances::Of(const std::string& channel) const {
  ChannelTolerance out = all;
  for (const auto& [pattern, tolerance] : patterns)
    if (Fits(channel, pattern)) out = tolerance;
  return out;
}

RecordTolerances ReadTolerances(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  RecordTolerances out;
  if (const auto all = root.Table("all")) out.all = ReadOne(*all);
  if (const auto channels = root.Table("channel"))
    for (const std::string& name : channels->Keys())
      out.patterns.emplace_back(name, ReadOne(*channels->Table(name)));
  out.events = Within(root, "events", 0, {"s", 0, 1e3, "how far an event may move"});
  root.RejectUnknownKeys();
  return out;
}

RecordDifference CompareRecords(const Record& a, const Record& b, const RecordTolerances& t) {
  RecordDifference out;
  out.length = LengthProblem(a, b);
  for (const Channel& c : a.channels) {
    const Channel* other = b.Find(c.name);
    if (other) {
      out.channels.push_back(CompareChannel(a, b, c, *other, t.Of(c.name)));
    } else {
      out.channels.emplace_back();
      out.channels.back().channel = c.name;
      out.channels.back().unit = c.unit;
      out.channels.back().verdict = ChannelVerdict::kLost;
      out.channels.back().first = a.start;
    }
  }
  for (const Channel& c : b.channels)
    if (!a.Find(c.name)) {
      out.channels.emplace_back();
      out.channels.back().channel = c.name;
      out.channels.back().unit = c.unit;
      out.channels.back().verdict = ChannelVerdict::kNew;
      out.channels.back().first = b.start;
    }
  return out;
}

bool RecordDifference::identical() const {
  return length.empty() && std::ranges::all_of(channels, [](const auto& c) {
           return c.verdict == ChannelVerdict::kSame;
         });
}
bool RecordDifference::agrees() const {
  return length.empty() && std::ranges::none_of(channels, [](const auto& c) { return c.bad(); });
}

const ChannelDifference* RecordDifference::First() const {
  const ChannelDifference* first = nullptr;
  for (const ChannelDifference& c : channels)
    if (c.bad() && (!first || c.first < first->first)) first = &c;
  return first;
}

const char* VerdictText(ChannelVerdict v) {
  switch (v) {
    case ChannelVerdict::kSame:
      return "same";
    case ChannelVerdict::kWithin:
      return "within";
    case ChannelVerdict::kDiffers:
      return "differs";
    case ChannelVerdict::kLost:
      return "lost";
    case ChannelVerdict::kNew:
      return "new";
    case ChannelVerdict::kOtherUnit:
      return "other unit";
    case ChannelVerdict::kNan:
      return "not a number";
  }
  return "";
}

}  // namespace ambrig
