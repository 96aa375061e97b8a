#include "scenarios/excitation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/math/constants.h"
#include "core/record/read_record.h"

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

Excitation ReadExcitation(const TomlTable& t, const std::string& directory, double duration) {
  Excitation e;
  e.where = t.Where();
  e.target = t.String("target");
  e.port = t.Choice("port", "force", "force, reference, current, duty");
  e.kind = t.Choice("kind", "", "multisine, sine, chirp, step, pulse, ramp, samples");
  e.start = t.Number("start", 0);
  e.stop = t.Number("stop", duration);
  if (!(std::isfinite(e.start) && std::isfinite(e.stop) && e.stop > e.start))
    t.Fail("stop", fmt::format("= {}, allowed: later than start = {}", e.stop, e.start));
  e.amplitude = t.Number("amplitude", e.kind == "samples" ? 1.0 : kRequired);
  if (!std::isfinite(e.amplitude))
    t.Fail("amplitude", "is missing or not finite, allowed: a number");
  if (e.kind == "sine") {
    e.frequency = t.Number("frequency");
    e.phase = t.Number("phase", 0);
  } else if (e.kind == "multisine") {
    e.frequencies = t.Numbers("frequencies");
    e.phases = t.Numbers("phases", std::vector<double>(e.frequencies.size(), 0.0));
    if (e.phases.size() != e.frequencies.size())
      t.Fail("phases", fmt::format("has {}, allowed: {} as in frequencies",
                                   Counted(e.phases.size(), "entry"), e.frequencies.size()));
  } else if (e.kind == "chirp") {
    e.f0 = t.Number("f0");
    e.f1 = t.Number("f1");
    e.phase = t.Number("phase", 0);
  } else if (e.kind == "samples") {
    const std::string file = t.String("file"), channel = t.String("channel");
    const Record r = ReadRecord(file.starts_with('/') ? file : directory + "/" + file);
    const Channel* c = r.Find(channel);
    if (!c) t.Fail("channel", fmt::format("= \"{}\" is not in {}", channel, file));
    const auto missing = std::find_if(c->samples.begin(), c->samples.end(),
                                      [](double v) { return !std::isfinite(v); });
    if (missing != c->samples.end())
      t.Fail("channel",
             fmt::format("= \"{}\" of {} has no number at {:.6g} s; what was commanded must be "
                         "known throughout",
                         channel, file,
                         r.TimeAt(static_cast<std::size_t>(missing - c->samples.begin()))));
    e.samples = c->samples;
    e.sample_rate = r.rate;
    e.sample_start = r.start;
  }
  t.RejectUnknownKeys();
  return e;
}

}  // namespace ambrig
