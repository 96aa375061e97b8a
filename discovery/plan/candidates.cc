#include "discovery/plan/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "core/math/constants.h"
#include "core/math/noise.h"
#include "discovery/model/linear_responses.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

constexpr int kLines = 15;          // of a multisine, per axis
constexpr double kForce = 0.03;     // amplitude of a line, of the rotor's weight
constexpr double kReference = 0.3;  // step of a reference, of the clearance
constexpr double kLoad = 0.25;      // step of a load, of the weight
// Lines of a multisine at most, of the rate of the controller and of that of the record's rows.
constexpr double kOfController = 0.3, kOfRecord = 0.4;
constexpr double kLeastBandwidth = 4;  // highest over lowest line
// Duration of a record of a free rotor, of the decay of its slowest mode; at most [s].
constexpr double kDecaysSeen = 3, kLongestPlanned = 10;

std::string Excited(const std::string& target, const std::string& port, const std::string& kind,
                    double start, double stop, double amplitude) {
  return fmt::format(
      "\n[[excitation]]\ntarget = \"{}\"\nport = \"{}\"\nkind = \"{}\"\nstart = {:.5f}\nstop = "
      "{:.5f}\namplitude = {:.6g}\n",
      target, port, kind, start, stop, amplitude);
}

/// Of the loop that levitates the rotor at rest [s]; 0 where there is none.
double SlowestDecayOf(const RigParameters& rig) {
  try {
    return LinearResponses(rig, rig, Scenario()).SlowestDecay();
  } catch (const std::runtime_error&) {
    return 0;
  }
}

/// Text of scenarios of one rig.
class Writer {
 public:
  Writer(const RigParameters& rig, const Abilities& abilities, std::uint64_t seed)
      : rig_(rig), able_(abilities), seed_(seed) {
    for (const BearingParameters& b : rig.bearings)
      for (const std::string& axis : b.Axes()) axes_.push_back(axis);
  }

  std::string Head(const std::string& title, double duration, double rate,
                   const char* state) const {
    return fmt::format(
        "name = \"{}\"\nrig = \"rig.toml\"\nduration = {:.5f}\nrecord_rate = {}\nseed = "
        "{}\nfault_tolerance = false\n\n[start]\nstate = \"{}\"\n",
        title, duration, rate, seed_, state);
  }
  static std::string Speed(double from, double to, double duration) {
    return fmt::format(
        "\n[speed]\nprofile = [[0.0, {0:.2f}], [{1:.5f}, {0:.2f}], [{2:.5f}, "
        "{3:.2f}], [{4:.5f}, {3:.2f}]]\n",
        from, 0.06 * duration, 0.94 * duration, to, duration);
  }

  /// Lines of all axes interleaved between f0 and f1 [Hz], multiples of 1/2 Hz.
  std::string Multisine(double duration, double f0, double f1, double size) const {
    std::string text;
    std::uint32_t drawn = 0;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      std::string frequencies, phases;
      double last = 0;
      for (int k = 0; k < kLines; ++k) {
        const double place =
            (k + static_cast<double>(a) / static_cast<double>(axes_.size())) / kLines;
        last = std::max(last + 0.5, std::round(2 * f0 * std::pow(f1 / f0, place)) / 2);
        frequencies += fmt::format("{}{:.1f}", k ? ", " : "", last);
        phases += fmt::format("{}{:.4f}", k ? ", " : "", 2 * kPi * Uniform(seed_, 7, drawn++));
      }
      text += fmt::format(
          "\n[[excitation]]\ntarget = \"{}\"\nport = \"force\"\nkind = \"multisine\"\nstart = "
          "0.03\nstop = {:.5f}\nfrequencies = [{}]\nphases = [{}]\namplitude = {:.6g}\n",
          axes_[a], duration, frequencies, phases, size * kForce * Weight());
    }
    return text;
  }

  /// One reference after the other, then one load after the other where loads can be had.
  std::string Steps(double duration, double size) const {
    std::string text;
    const std::size_t n = rig_.bearings.size();
    const double slot = 0.9 * duration / static_cast<double>(2 * n);
    for (std::size_t b = 0; b < n; ++b) {
      const BearingParameters& bearing = rig_.bearings[b];
      const std::vector<std::string> own = bearing.Axes();
      const double start = 0.05 * duration + slot * static_cast<double>(b);
      text += Excited(own[b % own.size()], "reference", "step", start, start + 0.7 * slot,
                      size * kReference * ClearanceOf(bearing) * (b % 2 ? -1 : 1));
      if (!bearing.kind->two_axes || !able_.load) continue;
      const double from = 0.05 * duration + slot * static_cast<double>(n + b);
      text += fmt::format(
          "\n[[load]]\nplane = \"{}\"\nforce = [{:.2f}, {:.2f}]\nstart = {:.5f}\nstop = {:.5f}\n",
          bearing.name, size * kLoad * Weight(), -0.6 * size * kLoad * Weight(), from,
          from + 0.75 * slot);
    }
    return text;
  }

  /// The least command in every coil, more in one pair of neighbours after the other: up in a
  /// ramp (and down again at once), or in a step.
  std::string Coils(double duration, const std::string& kind, bool off_centre, double size) const {
    std::string places, text;
    for (const BearingParameters& b : rig_.bearings) {
      const auto at = able_.clamp_at.find(b.name);
      if (off_centre && at != able_.clamp_at.end())
        places += fmt::format("{}{} = [{:.4g}, {:.4g}]", places.empty() ? "" : ", ", b.name,
                              at->second[0], at->second[1]);
      const int coils = b.coils(), slots = std::max(1, coils / 2);
      const double slot = 0.9 * duration / slots,
                   more = size * (able_.coil_most - able_.coil_least);
      for (int j = 1; j <= coils; ++j) {
        const std::string coil = CoilName(b.name, j - 1);
        text += Excited(coil, able_.coil_port, "step", 0, duration, able_.coil_least);
        if (more <= 0) continue;
        const double start = 0.05 * duration + slot * ((j - 1) / 2);
        text += Excited(coil, able_.coil_port, kind, start, start + 0.8 * slot, more);
      }
    }
    return (places.empty() ? "" : "position = { " + places + " }\n") + Speed(0, 0, duration) + text;
  }

  double Weight() const { return 9.81 * rig_.rotor.mass; }
  /// [Hz] that controller and logger can tell.
  double HighestLine() const {
    return std::min(kOfController * rig_.controller.rate, kOfRecord * able_.record_rate);
  }
  /// A usual duration [s], longer where the loop takes longer to answer.
  double Lasting(double usual) const {
    if (slowest_ < 0) slowest_ = SlowestDecayOf(rig_);
    return std::max(usual, std::min(kLongestPlanned, kDecaysSeen * slowest_));
  }

 private:
  const RigParameters& rig_;
  const Abilities& able_;
  std::uint64_t seed_;
  std::vector<std::string> axes_;
  mutable double slowest_ = -1;  // [s]
};

class Library {
 public:
  Library(const RigParameters& rig, const Abilities& abilities, std::uint64_t seed)
      : writer_(std::make_shared<Writer>(rig, abilities, seed)), able_(abilities) {}

  void Levitated(const std::string& title, const std::string& what, double duration, double from,
                 double to, const std::function<std::string(const Writer&, double)>& more) {
    out.push_back(
        {title, what, false, false, duration,
         [w = writer_, rate = able_.record_rate, title, duration, from, to, more](double size) {
           return w->Head(title, duration, rate, "levitated") + Writer::Speed(from, to, duration) +
                  more(*w, size);
         }});
  }
  void Multisines(double speed, const std::string& at) {
    struct Band {
      const char* name;
      double f0, f1, duration;
    };
    for (Band b :
         {Band{"low", 2, 60, 0.63}, Band{"broad", 5, 1500, 0.43}, Band{"high", 150, 2500, 0.33}}) {
      b.f1 = std::min(b.f1, writer_->HighestLine());
      b.duration = writer_->Lasting(b.duration);
      if (b.f1 < kLeastBandwidth * b.f0) continue;
      for (const double size : {1.0, 2.0})
        if (speed == 0 || (size == 1 && std::string(b.name) == "broad"))
          Levitated(fmt::format("{}{} multisine {}", size > 1 ? "strong " : "", b.name, at),
                    fmt::format("forces of many frequencies between {:g} and {:g} Hz on all axes",
                                b.f0, b.f1),
                    b.duration, speed, speed, [b, size](const Writer& w, double s) {
                      return w.Multisine(b.duration, b.f0, b.f1, size * s);
                    });
    }
  }
  void AddTurning() {
    for (const double part : {0.4, 1.0}) {
      const double speed = part * able_.top_speed;
      Multisines(speed, fmt::format("at {:.0f} Hz", speed / (2 * kPi)));
    }
    Levitated(fmt::format("run-up to {:.0f} Hz", able_.top_speed / (2 * kPi)),
              "a run-up without excitation", 0.6, 0, able_.top_speed,
              [](const Writer&, double) { return std::string(); });
  }
  void AddHeld() {
    const auto held = [&](const std::string& title, const std::string& what, double duration,
                          const std::string& kind, bool off_centre, bool burst, double size) {
      const double rate = burst ? able_.burst_rate : able_.record_rate;
      out.push_back({title, what, true, burst, duration,
                     [w = writer_, rate, title, duration, kind, off_centre, size](double s) {
                       return w->Head(title, duration, rate, "clamped") +
                              w->Coils(duration, kind, off_centre, size * s);
                     }});
    };
    const std::string ramps = "rotor held; coil pair after coil pair ramped up and switched down",
                      steps = "rotor held; coil pair after coil pair stepped up and down";
    held("held, ramps", ramps, 0.2, "ramp", false, false, 1);
    held("held, small ramps", ramps, 0.2, "ramp", false, false, 0.5);
    held("held, steps", steps, 0.2, "step", false, false, 1);
    if (!able_.clamp_at.empty()) {
      held("held off centre, ramps", ramps, 0.2, "ramp", true, false, 1);
      held("held off centre, steps", steps, 0.2, "step", true, false, 1);
    }
    if (!able_.burst) return;
    held("held, fast steps", steps + ", at the converters' rate", 0.012, "step", false, true, 0.5);
    held("held, fast ramps", ramps + ", at the converters' rate", 0.012, "ramp", false, true, 1);
  }
  void AddLevitated() {
    Multisines(0, "at rest");
    const double duration = writer_->Lasting(0.35);
    if (able_.reference)
      for (const double size : {0.6, 1.2})
        Levitated(
            size > 1 ? "large steps at rest" : "steps at rest",
            able_.load ? "steps of reference and load" : "steps of the reference", duration, 0, 0,
            [size, duration](const Writer& w, double s) { return w.Steps(duration, size * s); });
    if (able_.top_speed > 0) AddTurning();
  }
  void AddLanded() {
    out.push_back({"lift-off at rest", "lift-off from the auxiliary bearings", false, false, 0.2,
                   [w = writer_, rate = able_.record_rate](double) {
                     return w->Head("lift-off at rest", 0.2, rate, "resting") +
                            Writer::Speed(0, 0, 0.2);
                   }});
  }

  std::vector<PlanCandidate> out;

 private:
  std::shared_ptr<Writer> writer_;
  const Abilities& able_;
};

}  // namespace

std::vector<PlanCandidate> PlanCandidates(const RigParameters& rig, const Abilities& abilities,
                                          std::uint64_t seed) {
  // the writer outlives this call: it keeps its own copies
  const auto own = std::make_shared<std::pair<RigParameters, Abilities>>(rig, abilities);
  Library library(own->first, own->second, seed);
  if (abilities.levitate) library.AddLevitated();
  if (abilities.land) library.AddLanded();
  if (abilities.clamp) library.AddHeld();
  for (PlanCandidate& c : library.out)
    c.toml = [own, toml = c.toml](double size) { return toml(size); };
  return std::move(library.out);
}

}  // namespace ambrig
