// Records of kind "frf": which trace of a file is which response of the rig, and how well it is
// known.
#include "discovery/case/response_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "core/base/toml_checked.h"
#include "core/math/constants.h"
#include "core/record/column_names.h"
#include "core/record/read_record.h"
#include "core/record/units.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

constexpr double kHoverSeconds = 1;  // of the scenario where none is named

/// What the record says of its points.
struct PointKnowledge {
  double averages = 0, sd = 0, accuracy = 0;
  double frequency_gain = 1;
};

std::vector<TraceMapping> ReadTraceMappings(const TomlTable& t) {
  std::vector<TraceMapping> out;
  const auto responses = t.Table("responses");
  if (!responses) return out;
  for (const std::string& name : responses->Keys()) {
    TraceMapping m;
    m.response = m.trace = name;
    if (responses->IsString(name)) {
      m.trace = responses->String(name);
    } else {
      const TomlTable own = *responses->Table(name);
      m.trace = own.String("trace", name);
      m.unit = own.String("unit", "");
      m.coherence = own.String("coherence", "");
      m.excited = own.String("excited", "");
      m.gain = own.Number("gain", 1);
      if (!(std::abs(m.gain) > 0 && std::isfinite(m.gain)))
        own.Fail("gain", fmt::format("= {}, allowed: any but 0", m.gain));
      m.conjugate = own.Bool("conjugate", false);
      m.phase_gain = Within(own, "phase_gain", 1, {"-", 1e-3, 1e3, "phase over the file's"});
      m.late = Within(own, "late", 0, {"s", -10, 10, "delay of the instrument"});
      own.RejectUnknownKeys();
    }
    out.push_back(m);
  }
  return out;
}

/// SI per number of a response in `unit` ("um/N", "A"): numerator and denominator each.
double ResponseFactor(const std::string& unit, const RigResponse& r, const std::string& where) {
  if (unit.empty() || unit == "-") return 1;
  const std::size_t bar = unit.find('/');
  const std::string over = bar == std::string::npos ? "" : unit.substr(bar + 1);
  const auto factor = [&](const std::string& from, const char* to) {
    return from.empty() || from == "1" ? 1 : UnitFactor(from, to, where);
  };
  return factor(unit.substr(0, bar), r.output.unit()) / factor(over, r.input.unit());
}

std::string SiUnitOf(const RigResponse& r) {
  const std::string over = r.input.unit(), of = r.output.unit();
  if (over == of) return "-";
  return over.empty() ? of : of + "/" + over;
}

ResponsePoint PointNamed(const RigParameters& rig, const std::string& name, const TomlTable& t,
                         const std::string& key) {
  const auto point = ParseResponsePoint(rig, name);
  if (!point)
    t.Fail(key, fmt::format("\"{}\" is no point of this rig, allowed: {}", name,
                            ResponsePointsText(rig)));
  return *point;
}

/// The port that was driven: the input, else what the case says, else that of the same axis or
/// coil.
ResponsePoint ExcitedOf(const RigParameters& rig, const RigResponse& r, const std::string& stated,
                        bool held, const TomlTable& t) {
  std::string name = stated;
  if (name.empty() && r.input.port()) return r.input;
  if (name.empty() && !r.input.axis.empty()) name = r.input.axis + ".force";
  if (name.empty() && held)
    name = CoilName(rig.bearings[r.input.bearing].name, r.input.index) + ".current";
  if (name.empty())
    t.Fail("excited",
           "is missing, allowed: the port that was driven, e.g. \"A.x.force\", for " + r.name());
  const ResponsePoint p = PointNamed(rig, name, t, "excited");
  if (!p.port())
    t.Fail("excited", "= \"" + name + "\" is no port, allowed: .force, .reference, .sensor, .load");
  if (r.input.port()) return r.input;  // `excited` stands for other responses of the record
  return p;
}

RigResponse NamedResponse(const RigParameters& rig, const TraceMapping& m, const CaseRecord& r,
                          const TomlTable& t) {
  const std::size_t bar = m.response.find('/');
  if (bar == std::string::npos)
    t.Fail("responses",
           fmt::format("\"{}\" is no response, allowed: {}", m.response, ResponsePointsText(rig)));
  RigResponse out;
  out.output = PointNamed(rig, m.response.substr(0, bar), t, "responses");
  out.input = PointNamed(rig, m.response.substr(bar + 1), t, "responses");
  if (out.output.port())
    t.Fail("responses",
           "\"" + m.response + "\": a port is no output, allowed: " + ResponsePointsText(rig));
  const bool held = r.scenario.start == StartState::kClamped;
  out.excited =
      ExcitedOf(rig, out, m.excited.empty() ? t.String("excited", "") : m.excited, held, t);
  if (out.excited.of_coil() != held)
    t.Fail("responses",
           fmt::format("\"{}\" is driven at {}, allowed: {}", m.response, out.excited.name,
                       held ? "a coil's port (the scenario holds the rotor)"
                            : "an axis' port (a coil's needs a scenario with start \"clamped\")"));
  const auto of_coil = [](const ResponsePoint& p) {
    return p.port() || p.kind == PointKind::kCurrent || p.kind == PointKind::kSetPoint;
  };
  if (held && !(of_coil(out.output) && of_coil(out.input)))
    t.Fail("responses",
           "\"" + m.response + "\": of a held rotor allowed are currents and set-points");
  out.unit = SiUnitOf(out);
  out.from = m;
  return out;
}

/// nullptr: none that belongs to this trace.
const std::vector<double>* CoherenceOf(const FrequencyResponses& f, const std::string& name,
                                       const std::string& trace) {
  for (const MeasuredCoherence& c : f.coherence)
    if (c.name == (name.empty() ? trace : name)) return &c.values;
  const bool only = name.empty() && f.coherence.size() == 1 &&
                    (f.coherence[0].name.empty() || f.responses.size() == 1);
  return only ? &f.coherence[0].values : nullptr;
}

/// A value of the file at `f` [Hz] without what its instrument did to its phase.
Complex SetRight(Complex v, double f, const TraceMapping& m) {
  if (m.phase_gain != 1) v = std::polar(std::abs(v), m.phase_gain * std::arg(v));
  if (m.conjugate) v = std::conj(v);
  return m.late == 0 ? v : v * std::polar(1.0, 2 * kPi * f * m.late);
}

/// Values in SI, and what each point is worth.
void Fill(const FrequencyResponses& f, const TraceMapping& m, const PointKnowledge& known,
          const TomlTable& t, RigResponse& out) {
  const auto at = std::ranges::find(f.responses, m.trace, &MeasuredResponse::name);
  if (at == f.responses.end()) {
    std::string names;
    for (const MeasuredResponse& r : f.responses) names += (names.empty() ? "" : ", ") + r.name;
    t.Fail("responses", fmt::format("trace \"{}\" of {} is not in {}, allowed: {}", m.trace,
                                    out.name(), t.String("data"), names));
  }
  const double factor =
      m.gain * ResponseFactor(m.unit.empty() ? at->unit : m.unit, out, t.Where("responses"));
  const std::vector<double>* coherence = CoherenceOf(f, m.coherence, m.trace);
  if (!m.coherence.empty() && !coherence)
    t.Fail("responses",
           fmt::format("coherence \"{}\" is not in {}", m.coherence, t.String("data")));
  const bool averaged = coherence && known.averages > 0;
  out.sd_known = averaged || known.sd > 0;
  for (std::size_t k = 0; k < at->values.size(); ++k) {
    const Complex v = SetRight(at->values[k], known.frequency_gain * f.frequency[k], m);
    out.values.push_back(factor * v);
    const double size = std::abs(out.values.back());
    const double random = averaged       ? CoherenceSd(size, (*coherence)[k], known.averages)
                          : known.sd > 0 ? known.sd * size
                                         : size;
    out.sd.push_back(std::hypot(random, out.sd_known ? known.accuracy * size : 0));
  }
}

/// Every point over its sd, real and imaginary part: what a fit sees.
void Weigh(const RigParameters& rig, CaseRecord& r) {
  const double nyquist =
      0.5 * (r.scenario.start == StartState::kClamped ? rig.amplifier.switching_frequency
                                                      : rig.controller.rate);
  r.data.rate = 1;
  for (const RigResponse& response : r.responses.responses)
    for (const char* part : {"Re", "Im"}) {
      Channel channel{fmt::format("{}({})", part, response.name()), "-", {}};
      ChannelQuality quality{channel.name, "good", true, {}, 0, 0};
      for (std::size_t k = 0; k < response.values.size(); ++k) {
        const Complex v = response.values[k] / response.sd[k];
        channel.samples.push_back(part[0] == 'R' ? v.real() : v.imag());
        const double f = r.responses.frequency[k];
        quality.ok.push_back(std::isfinite(channel.samples.back()) &&
                             std::isfinite(response.sd[k]) && f > 0 && f < 0.98 * nyquist);
        quality.missing += quality.ok.back() == 0;
      }
      r.data.channels.push_back(std::move(channel));
      r.quality.push_back(std::move(quality));
    }
}

void ReadOperation(const TomlTable& t, const Case& c, CaseRecord& r) {
  const double speed =
      Within(t, "speed", 0, {"rad/s", -1e5, 1e5, "speed of the shaft while it was measured"});
  if (t.Has("scenario")) {
    if (t.Has("speed")) t.Fail("speed", "and scenario, allowed: one of them");
    r.scenario_file = ExistingFile(t, "scenario");
    r.scenario = ReadScenario(r.scenario_file, c.rig);
    if (r.scenario.start == StartState::kResting)
      t.Fail("scenario", "starts at rest, allowed: \"levitated\" or \"clamped\"");
    return;
  }
  r.scenario.name = speed == 0 ? "hover" : fmt::format("hover at {:g} rad/s", speed);
  r.scenario.rig_file = c.rig_file;
  r.scenario.duration = kHoverSeconds;
  r.scenario.record_rate = c.rig.controller.rate;
  r.scenario.speed = SpeedProfile(std::vector<std::vector<double>>{{0.0, speed}});
}

}  // namespace

void ReadResponseRecord(const TomlTable& t, Case& c, CaseRecord& r) {
  r.kind = RecordKind::kFrf;
  ReadOperation(t, c, r);
  const Measurement m = ReadMeasurement(r.data_file);
  const FrequencyResponses& f = m.frequency;
  if (f.responses.empty() || f.frequency.empty())
    t.Fail("data", fmt::format("= {} holds no frequency responses with their frequencies, allowed: "
                               "docs/guide/records.md",
                               r.data_file));
  PointKnowledge known;
  known.averages = Within(t, "averages", 0, {"-", 0, 1e9, "averages behind a coherence"});
  known.sd = Within(t, "sd", 0, {"-", 0, 10, "sd of a point over its magnitude"});
  known.accuracy =
      Within(t, "accuracy", 0.002, {"-", 0, 1, "of a magnitude, that no averaging improves"});
  known.frequency_gain =
      Within(t, "frequency_gain", 1, {"-", 1e-6, 1e6, "frequency in Hz over the file's"});
  r.responses.frequency_gain = known.frequency_gain;
  for (const double at : f.frequency) r.responses.frequency.push_back(known.frequency_gain * at);
  std::vector<TraceMapping> mappings = ReadTraceMappings(t);
  if (mappings.empty())
    for (const MeasuredResponse& trace : f.responses) {
      mappings.emplace_back();
      mappings.back().response = mappings.back().trace = trace.name;
    }
  for (const TraceMapping& mapping : mappings) {
    r.responses.responses.push_back(NamedResponse(c.rig, mapping, r, t));
    Fill(f, mapping, known, t, r.responses.responses.back());
  }
  if (!f.coherence.empty() && known.averages == 0 && known.sd == 0)
    c.notes.push_back(r.data_file +
                      ": coherence without `averages`: the sd is estimated from the scatter");
  Weigh(c.rig, r);
  for (const ChannelQuality& q : r.quality)
    if (q.missing > 0 && q.channel.starts_with("Re"))
      c.notes.push_back(fmt::format(
          "{}: {}: {} of {} points left out (no number, no coherence, or beyond half the sampling "
          "rate)",
          r.data_file, q.channel, q.missing, q.ok.size()));
}

}  // namespace ambrig
