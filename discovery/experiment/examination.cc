#include "discovery/experiment/examination.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "core/math/constants.h"
#include "core/math/noise.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

/// Numbers drawn one after the other from one seed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double Uniform(double lo, double hi) {
    return lo + (hi - lo) * ambrig::Uniform(seed_, 0, next_++);
  }

 private:
  std::uint64_t seed_;
  std::uint32_t next_ = 0;
};

struct ExaminationWriter {
  const RigParameters& rig;
  Draw draw;
  double weight = 0;  // [N]

  std::string Head(const std::string& title, double duration, double rate, const char* state) {
    return fmt::format(
        "name = \"{}\"\nrig = \"rig.toml\"\nduration = {}\nrecord_rate = {}\nseed = "
        "{}\nfault_tolerance = false\n\n[start]\nstate = \"{}\"\n",
        title, duration, rate, 1 + static_cast<long>(draw.Uniform(0, 1e9)), state);
  }
  static std::string Speed(double from, double to, double duration) {
    const double edge = 0.06 * duration;
    return fmt::format("\n[speed]\nprofile = [[0.0, {0}], [{1}, {0}], [{2}, {3}], [{4}, {3}]]\n",
                       from, edge, duration - edge, to, duration);
  }
  static std::string Excitation(const std::string& target, const char* port, const char* kind,
                                double start, double stop, double amplitude) {
    return fmt::format(
        "\n[[excitation]]\ntarget = \"{}\"\nport = \"{}\"\nkind = \"{}\"\nstart = {:.4f}\nstop = "
        "{:.4f}\namplitude = {:.6g}\n",
        target, port, kind, start, stop, amplitude);
  }
  std::vector<std::string> Axes() const {
    std::vector<std::string> axes;
    for (const BearingParameters& b : rig.bearings)
      for (const std::string& axis : b.Axes()) axes.push_back(axis);
    return axes;
  }

  /// Lines of all axes interleaved, spread over 5 Hz to 1500 Hz or what the controller's rate
  /// allows, whole periods in 2 s.
  std::string Multisine(double duration) {
    const std::vector<std::string> axes = Axes();
    std::string text;
    const int lines = 17;
    const double top = std::min(1500.0, 0.45 * rig.controller.rate);
    for (std::size_t a = 0; a < axes.size(); ++a) {
      std::string frequencies, phases;
      double last = 0;
      for (int k = 0; k < lines; ++k) {
        const double place =
            (k + static_cast<double>(a) / static_cast<double>(axes.size())) / lines;
        const double f = std::max(last + 0.5, std::round(2 * 5 * std::pow(top / 5, place)) / 2);
        last = f;
        frequencies += fmt::format("{}{:.1f}", k ? ", " : "", f);
        phases += fmt::format("{}{:.4f}", k ? ", " : "", draw.Uniform(0, 2 * kPi));
      }
      text += fmt::format(
          "\n[[excitation]]\ntarget = \"{}\"\nport = \"force\"\nkind = \"multisine\"\nstart = "
          "0.03\nstop = {}\nfrequencies = [{}]\nphases = [{}]\namplitude = {:.6g}\n",
          axes[a], duration, frequencies, phases, 0.025 * weight * draw.Uniform(0.7, 1.4));
    }
    return text;
  }

  std::string Steps(double duration, double share) {
    std::string text;
    const std::vector<std::string> axes = Axes();
    const std::size_t n = rig.bearings.size();
    const double slot = 0.9 * duration / static_cast<double>(2 * n);
    for (std::size_t b = 0; b < n; ++b) {
      const BearingParameters& bearing = rig.bearings[b];
      const std::vector<std::string> own = bearing.Axes();
      const double start = 0.05 * duration + slot * static_cast<double>(b);
      text += Excitation(own[b % own.size()], "reference", "step", start, start + 0.7 * slot,
                         share * ClearanceOf(bearing) * draw.Uniform(0.8, 1.1) * (b % 2 ? -1 : 1));
      if (!bearing.kind->two_axes) continue;
      const double from = 0.05 * duration + slot * static_cast<double>(n + b);
      text += fmt::format(
          "\n[[load]]\nplane = \"{}\"\nforce = [{:.2f}, {:.2f}]\nstart = {:.4f}\nstop = {:.4f}\n",
          bearing.name, weight * draw.Uniform(-0.3, 0.3), weight * draw.Uniform(-0.3, 0.3), from,
          from + 0.75 * slot);
    }
    return text;
  }

  /// Bias in every coil, more in one pair of neighbours after the other, rotor held off centre.
  std::string Clamped(double duration, const char* kind, double more) {
    std::string places, text;
    for (const BearingParameters& b : rig.bearings) {
      if (!b.kind->two_axes) continue;
      const double reach = 0.5 * ClearanceOf(b);
      places += fmt::format("{}{} = [{:.3g}, {:.3g}]", places.empty() ? "" : ", ", b.name,
                            draw.Uniform(-reach, reach), draw.Uniform(-reach, reach));
      const int coils = b.coils();
      const double slot = 0.9 * duration / (coils / 2);
      for (int j = 1; j <= coils; ++j) {
        const std::string coil = CoilName(b.name, j - 1);
        text += Excitation(coil, "current", "step", 0, duration, 1.2);
        const double start = 0.05 * duration + slot * ((j - 1) / 2);
        text += Excitation(coil, "current", kind, start, start + 0.8 * slot,
                           more * draw.Uniform(0.8, 1.1));
      }
    }
    return (places.empty() ? "" : "position = { " + places + " }\n") + Speed(0, 0, duration) + text;
  }
};

}  // namespace

std::vector<ExaminationRecord> Examination(const RigParameters& rig, std::uint64_t seed,
                                           const ExaminationNeeds& needs) {
  ExaminationWriter w{rig, Draw(seed), rig.rotor.mass * 9.81};
  const double rate = rig.controller.rate,
               burst = rig.amplifier.switching_frequency * rig.amplifier.adc_samples_per_period;
  const double most = 0.8 * rig.amplifier.i_max - 1.2;
  std::vector<ExaminationRecord> out;
  const auto levitated = [&](const std::string& title, double duration, double from, double to,
                             const std::string& more, bool validate) {
    out.push_back({title,
                   w.Head(title, duration, rate, "levitated") +
                       ExaminationWriter::Speed(from, to, duration) + more,
                   validate, false});
  };
  levitated("multisine at rest", 0.43, 0, 0, w.Multisine(0.43), false);
  levitated("multisine at 60 Hz", 0.35, 377, 377, w.Multisine(0.35), false);
  levitated("run-up to 250 Hz", 0.6, 0, 1571, "", false);
  levitated("steps of reference and load at rest", 0.35, 0, 0, w.Steps(0.35, 0.3), false);
  out.push_back(
      {"clamped, current ramps",
       w.Head("clamped, current ramps", 0.2, rate, "clamped") + w.Clamped(0.2, "ramp", most), false,
       false});
  out.push_back({"clamped, current pulses",
                 w.Head("clamped, current pulses", 0.012, burst, "clamped") +
                     w.Clamped(0.012, "step", 0.4 * most),
                 false, true});
  if (needs.contact)
    for (const bool validate : {false, true}) {
      const std::string title = validate ? "lift-off at 80 Hz" : "lift-off at 50 Hz";
      const double speed = validate ? 503 : 314;
      out.push_back(
          {title, w.Head(title, 0.2, rate, "resting") + ExaminationWriter::Speed(speed, speed, 0.2),
           validate, false});
    }
  if (needs.free_speed)
    for (const double speed : {1571.0, 900.0}) {
      const std::string title = fmt::format("coast-down from {:.0f} rad/s", speed);
      out.push_back({title,
                     w.Head(title, 0.4, rate, "levitated") +
                         fmt::format("\n[speed]\nprofile = [[0.0, {}]]\nfree_from = 0.02\n", speed),
                     speed < 1000, false});
    }
  levitated("multisine at 180 Hz", 0.3, 1131, 1131, w.Multisine(0.3), true);
  levitated("steps at 100 Hz", 0.3, 628, 628, w.Steps(0.3, 0.2), true);
  out.push_back({"clamped off centre, current ramps",
                 w.Head("clamped off centre, current ramps", 0.15, rate, "clamped") +
                     w.Clamped(0.15, "ramp", 0.9 * most),
                 true, false});
  return out;
}

Case EmptyCase(const RigParameters& rig, const std::vector<ExaminationRecord>& records) {
  Case c;
  c.file = "examination";
  c.rig = rig;
  for (const ExaminationRecord& e : records) {
    CaseRecord r;
    r.scenario = ReadScenarioText(e.toml, e.title, rig);
    r.scenario_file = r.data_file = e.title;
    r.validate = e.validate;
    r.data.rate = r.scenario.record_rate;
    const auto rows = static_cast<std::size_t>(
        std::floor(r.scenario.duration * r.scenario.record_rate * (1 + 1e-12)));
    const bool clamped = r.scenario.start == StartState::kClamped;
    const auto add = [&](const std::vector<ChannelId>& channels) {
      for (const ChannelId& id : channels)
        r.data.channels.push_back(
            {id.name(), std::string(id.row().unit), std::vector<double>(rows, 0)});
    };
    for (const BearingParameters& b : rig.bearings) {
      for (const ChannelKind kind :
           {ChannelKind::kReading, ChannelKind::kCoilCurrent, ChannelKind::kSetPoint})
        add(ChannelsOf(b, kind));
      if (clamped && !e.burst && b.kind->two_axes) add(ChannelsOf(b, ChannelKind::kLoadCell));
    }
    for (const ChannelKind kind : {ChannelKind::kBus, ChannelKind::kSpeed, ChannelKind::kAngle})
      add(ChannelsOf(rig, kind));
    for (const Channel& ch : r.data.channels)
      r.quality.push_back({ch.name, "good", true, std::vector<char>(rows, 1), 0, 0});
    c.records.push_back(std::move(r));
  }
  return c;
}

void KeepChannels(CaseRecord& record, const std::set<std::string>& names) {
  for (std::size_t k = record.data.channels.size(); k-- > 0;) {
    if (names.contains(record.data.channels[k].name)) continue;
    record.data.channels.erase(record.data.channels.begin() + static_cast<std::ptrdiff_t>(k));
    record.quality.erase(record.quality.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

}  // namespace ambrig
