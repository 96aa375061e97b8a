#include "core/record/frequency_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/errors.h"
#include "core/base/parameters.h"
#include "core/record/text_cells.h"
#include "core/record/time_base.h"
#include "core/record/units.h"

namespace ambrig {

namespace {

enum class Part { kReal, kImaginary, kMagnitude, kPhase, kCoherence };

struct PartWord {
  std::string_view word;  // in small letters
  Part part;
};
constexpr PartWord kPartWords[] = {
    {"re", Part::kReal},        {"real", Part::kReal},           {"im", Part::kImaginary},
    {"imag", Part::kImaginary}, {"imaginary", Part::kImaginary}, {"abs", Part::kMagnitude},
    {"mag", Part::kMagnitude},  {"magnitude", Part::kMagnitude}, {"amplitude", Part::kMagnitude},
    {"phi", Part::kPhase},      {"arg", Part::kPhase},           {"phase", Part::kPhase},
    {"angle", Part::kPhase},    {"coherence", Part::kCoherence}, {"coh", Part::kCoherence},
};

std::optional<Part> PartOf(std::string_view word) {
  const std::string small = LowerCase(Trim(word));
  for (const PartWord& w : kPartWords)
    if (w.word == small) return w.part;
  return std::nullopt;
}

/// A column as a part of a response.
struct PartColumn {
  const Channel* column;
  std::string of;  // "Trace 1: Gain", "A.x/A.fx", may be empty
  Part part;
  bool used = false;
};

/// "Re(x)", "x: Real", "x Phase", "x_re", "Magnitude".
std::optional<PartColumn> ParsePart(const Channel& c) {
  const std::string_view name = Trim(c.name);
  if (const std::size_t open = name.find('('); open != std::string_view::npos && name.back() == ')')
    if (const auto part = PartOf(name.substr(0, open)))
      return PartColumn{&c, std::string(Trim(name.substr(open + 1, name.size() - open - 2))),
                        *part};
  const std::size_t gap = name.find_last_of(" :_.");
  const std::size_t from = gap == std::string_view::npos ? 0 : gap + 1;
  const auto part = PartOf(name.substr(from));
  if (!part) return std::nullopt;
  std::string_view of = name.substr(0, from);
  while (!of.empty() && std::string_view(" :_.").find(of.back()) != std::string_view::npos)
    of.remove_suffix(1);
  return PartColumn{&c, std::string(of), *part};
}

/// "Trace 2: Gain" is "Gain": some analysers show magnitude and phase as two traces.
std::string WithoutTrace(const std::string& of) {
  const std::size_t colon = of.find(':');
  const bool trace = colon != std::string::npos && LowerCase(of).starts_with("trace ");
  return trace ? std::string(Trim(std::string_view(of).substr(colon + 1))) : of;
}

PartColumn* Partner(std::vector<PartColumn>& parts, const PartColumn& of, Part wanted) {
  const auto find = [&](auto&& same) -> PartColumn* {
    const auto it = std::find_if(parts.begin(), parts.end(), [&](const PartColumn& p) {
      return !p.used && p.part == wanted && same(p.of);
    });
    return it == parts.end() ? nullptr : &*it;
  };
  if (PartColumn* p = find([&](const std::string& name) { return name == of.of; })) return p;
  const std::string plain = WithoutTrace(of.of);
  return find([&](const std::string& name) { return WithoutTrace(name) == plain; });
}

MeasuredResponse Combine(const PartColumn& a, const PartColumn& b, const std::string& path) {
  MeasuredResponse r;
  r.name = a.of.empty() ? std::string("response") : a.of;
  r.unit = a.column->unit;
  if (a.part == Part::kReal && a.column->unit != b.column->unit)
    throw InputError(path + ": " + a.column->name + " [" + a.column->unit + "] and " +
                     b.column->name + " [" + b.column->unit + "]: allowed: one unit");
  double angle = 1;
  if (a.part == Part::kMagnitude) {
    if (b.column->unit.empty())
      throw InputError(path + ": " + b.column->name + ": unit missing, allowed deg, rad");
    angle = UnitFactor(b.column->unit, "rad", path + ": " + b.column->name);
  }
  const bool decibel = a.part == Part::kMagnitude && LowerCase(a.column->unit) == "db";
  if (decibel) r.unit = "";
  for (std::size_t k = 0; k < a.column->samples.size(); ++k) {
    const double first = a.column->samples[k], second = b.column->samples[k];
    const double size = decibel ? std::pow(10, first / 20) : first;
    r.values.push_back(a.part == Part::kReal
                           ? std::complex<double>(first, second)
                           : size * std::exp(std::complex<double>(0, angle * second)));
  }
  return r;
}

bool IsFrequencyName(std::string_view name) {
  constexpr std::array<std::string_view, 4> kNames = {"f", "freq", "frequency", "frequenz"};
  return std::count(kNames.begin(), kNames.end(), LowerCase(Trim(name))) > 0;
}

}  // namespace

bool IsFrequencyTable(const TextTable& table) {
  if (table.columns.size() < 2 || !IsFrequencyName(table.columns.front().name)) return false;
  const std::string& unit = table.columns.front().unit;
  const std::string si = SiUnit(unit);
  if (!unit.empty() && si != "Hz" && si != "rad/s") return false;
  return std::none_of(table.columns.begin(), table.columns.end(),
                      [](const Channel& c) { return IsTimeName(c.name); });
}

Measurement ResponsesOfTable(const TextTable& table, const std::string& path) {
  Measurement out;
  out.record.notes = table.notes;
  const Channel& axis = table.columns.front();
  const double hertz = axis.unit.empty() ? 1
                       : SiUnit(axis.unit) == "rad/s"
                           ? UnitFactor(axis.unit, "rad/s") / (2 * std::numbers::pi)
                           : UnitFactor(axis.unit, "Hz");
  for (const double f : axis.samples) out.frequency.frequency.push_back(hertz * f);
  std::vector<PartColumn> parts;
  const auto left_out = [&](const Channel& c, const std::string& why) {
    out.record.notes.push_back(path + ": " + c.name + " " + why + ", left out");
  };
  for (std::size_t k = 1; k < table.columns.size(); ++k) {
    if (const auto part = ParsePart(table.columns[k]))
      parts.push_back(*part);
    else
      left_out(table.columns[k], "is no real or imaginary part, magnitude or phase");
  }
  for (PartColumn& p : parts) {
    if (p.part == Part::kCoherence) {
      out.frequency.coherence.push_back({p.of, p.column->samples});
      if (p.column->unit == "%")
        for (double& v : out.frequency.coherence.back().values) v /= 100;
      p.used = true;
    }
    if (p.part != Part::kReal && p.part != Part::kMagnitude) continue;
    PartColumn* other = Partner(parts, p, p.part == Part::kReal ? Part::kImaginary : Part::kPhase);
    if (other == nullptr) continue;
    p.used = other->used = true;
    out.frequency.responses.push_back(Combine(p, *other, path));
  }
  for (const PartColumn& p : parts)
    if (!p.used) left_out(*p.column, "has no partner (real with imaginary, magnitude with phase)");
  if (out.frequency.responses.empty())
    throw InputError(path +
                     ": frequencies, but no response: allowed are Re(x) and Im(x), x: Real " +
                     "and x: Imag, x: Magnitude (dB) and x: Phase (deg)");
  CheckResponses(out.frequency, path);
  return out;
}

void CheckFrequencies(const std::vector<double>& f, const std::string& where) {
  for (std::size_t k = 0; k < f.size(); ++k)
    if (!std::isfinite(f[k]) || f[k] < 0 || (k > 0 && f[k] <= f[k - 1]))
      throw InputError(where + ": frequency " + std::to_string(k + 1) + " = " + NumberText(f[k]) +
                       " Hz, allowed: finite, not negative, increasing");
}

void CheckResponses(FrequencyResponses& responses, const std::string& where) {
  std::vector<std::string> names;
  for (MeasuredResponse& r : responses.responses) {
    r.name = Utf8(r.name);
    r.unit = Utf8(r.unit);
    if (std::count(names.begin(), names.end(), r.name) > 0)
      throw InputError(where + ": response " + r.name + " is there twice");
    names.push_back(r.name);
    if (r.values.size() != responses.points())
      throw InputError(where + ": response " + r.name + " has " + std::to_string(r.values.size()) +
                       " points, " + names.front() + " has " + std::to_string(responses.points()));
  }
  for (const MeasuredCoherence& c : responses.coherence)
    for (std::size_t k = 0; k < c.values.size(); ++k)
      if (c.values[k] < -1e-6 || c.values[k] > 1 + 1e-6)
        throw InputError(where + ": coherence " + c.name + ", point " + std::to_string(k + 1) +
                         " = " + NumberText(c.values[k]) + ", allowed: 0 to 1");
  const std::vector<double>& f = responses.frequency;
  if (!f.empty() && f.size() != responses.points())
    throw InputError(where + ": " + std::to_string(f.size()) + " frequencies, " +
                     std::to_string(responses.points()) + " points");
  CheckFrequencies(f, where);
}

}  // namespace ambrig
