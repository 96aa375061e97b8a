#include "scenarios/excitation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/counted.h"
#include "core/base/toml_checked.h"
#include "core/math/constants.h"
#include "core/record/column_names.h"
#include "core/record/read_record.h"
#include "core/record/units.h"

namespace ambrig {

double Excitation::Value(double t) const {
  if (!(t >= start && t < stop)) return 0;
  const double s = t - start;
  if (kind == "step" || kind == "pulse") return amplitude;
  if (kind == "ramp") return amplitude * s / (stop - start);
  if (kind == "sine") return amplitude * std::sin(2 * kPi * frequency * s + phase);
  if (kind == "multisine") {
    double sum = 0;
    for (std::size_t k = 0; k < frequencies.size(); ++k)
      sum += std::sin(2 * kPi * frequencies[k] * s + phases[k]);
    return amplitude * sum;
  }
  if (kind == "chirp") {
    const double rate = (f1 - f0) / (stop - start);
    return amplitude * std::sin(2 * kPi * (f0 + 0.5 * rate * s) * s + phase);
  }
  // samples: the last one given at or before t
  const double k = std::floor((t - sample_start) * sample_rate + 1e-6);
  if (k < 0 || samples.empty()) return 0;
  return amplitude * samples[std::min(samples.size() - 1, static_cast<std::size_t>(k))];
}

namespace {

struct PortRange {
  std::string_view port;
  Range amplitude;
};
constexpr PortRange kPorts[] = {
    {"force", {"N", -1e8, 1e8, "amplitude of a force"}},
    {"reference", {"m", -1, 1, "amplitude of a reference position"}},
    {"current", {"A", -1e4, 1e4, "amplitude of a coil's set-point"}},
    {"duty", {"-", -2, 2, "amplitude of a duty"}},
};
constexpr Range kTime{"s", -1e5, 1e5, "scenario time"};
constexpr Range kFrequency{"Hz", 0, 1e6, "of the commanded signal"};
constexpr Range kPhase{"rad", -1e4, 1e4, "of the commanded signal"};
constexpr Range kFactor{"-", -1e9, 1e9, "factor on the samples"};

const Range& AmplitudeOf(const std::string& port) {
  for (const PortRange& p : kPorts)
    if (p.port == port) return p.amplitude;
  throw std::logic_error("no port " + port);
}

/// Samples of a file in the port's SI unit; a column without unit is in SI.
void ReadSamples(const TomlTable& t, const std::string& directory, Excitation& e) {
  const std::string channel = t.String("channel");
  const std::string file = t.String("file"),
                    path = file.starts_with('/') ? file : directory + "/" + file;
  if (!std::filesystem::is_regular_file(path))
    t.Fail("file", fmt::format("= \"{}\", allowed: a file ({}: no such file)", file, path));
  const Record r = ReadRecord(path);
  const Channel* c = FindColumn(r, channel);
  if (!c)
    t.Fail("channel",
           fmt::format("= \"{}\" is not in {}, allowed: {}", channel, path, ColumnsOf(r, channel)));
  const auto missing = std::find_if(c->samples.begin(), c->samples.end(),
                                    [](double v) { return !std::isfinite(v); });
  if (missing != c->samples.end())
    t.Fail("channel",
           fmt::format("= \"{}\" of {} has no number at {:.6g} s; what was commanded "
                       "must be known throughout",
                       channel, path,
                       r.TimeAt(static_cast<std::size_t>(missing - c->samples.begin()))));
  const Range& range = AmplitudeOf(e.port);
  const double si = c->unit.empty()
                        ? 1
                        : UnitFactor(c->unit, range.unit,
                                     fmt::format("{} = \"{}\" of {} on port {}", t.Where("channel"),
                                                 channel, path, e.port));
  for (const double v : c->samples) {
    const double value = si * e.amplitude * v;
    if (!(range.lo <= value && value <= range.hi))
      t.Fail("channel",
             fmt::format("= \"{}\" of {} holds {} {}, allowed {} to {} {} on port {}", channel,
                         path, value, range.unit, range.lo, range.hi, range.unit, e.port));
    e.samples.push_back(si * v);
  }
  e.sample_rate = r.rate;
  e.sample_start = r.start;
}

}  // namespace

Excitation ReadExcitation(const TomlTable& t, const std::string& directory, double duration) {
  Excitation e;
  e.where = t.Where();
  e.target = t.String("target");
  e.port = t.Choice("port", "force", "force, reference, current, duty");
  e.kind = t.Choice("kind", "", "multisine, sine, chirp, step, pulse, ramp, samples");
  e.start = Within(t, "start", 0, kTime);
  e.stop = Within(t, "stop", duration, kTime);
  if (!(e.stop > e.start))
    t.Fail("stop", fmt::format("= {} s, allowed: later than start = {} s", e.stop, e.start));
  e.amplitude = e.kind == "samples" ? Within(t, "amplitude", 1.0, kFactor)
                                    : Within(t, "amplitude", kRequired, AmplitudeOf(e.port));
  if (e.kind == "sine") {
    e.frequency = Within(t, "frequency", kRequired, kFrequency);
    e.phase = Within(t, "phase", 0, kPhase);
  } else if (e.kind == "multisine") {
    if (!t.Has("frequencies"))
      t.Fail("frequencies", "is missing, allowed: an array of numbers in Hz");
    e.frequencies = AllWithin(t, "frequencies", {}, kFrequency);
    if (e.frequencies.empty()) t.Fail("frequencies", "= [], allowed: at least one frequency in Hz");
    e.phases = AllWithin(t, "phases", std::vector<double>(e.frequencies.size(), 0.0), kPhase);
    if (e.phases.size() != e.frequencies.size())
      t.Fail("phases", fmt::format("has {}, allowed: {} as in frequencies",
                                   Counted(e.phases.size(), "entry"), e.frequencies.size()));
  } else if (e.kind == "chirp") {
    e.f0 = Within(t, "f0", kRequired, kFrequency);
    e.f1 = Within(t, "f1", kRequired, kFrequency);
    e.phase = Within(t, "phase", 0, kPhase);
  } else if (e.kind == "samples") {
    ReadSamples(t, directory, e);
  }
  t.RejectUnknownKeys();
  return e;
}

}  // namespace ambrig
