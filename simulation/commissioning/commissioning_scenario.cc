#include "simulation/commissioning/commissioning_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "core/math/constants.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kLowestTone = 60, kHighestTone = 2000;           // [Hz]
constexpr double kFirstPotential = 0.025, kLastPotential = 0.06;  // of the switching frequency
constexpr double kCircleTurns = 3, kFastestCircle = 25;           // of the reference; [Hz]
constexpr double kFirstChirp = 20, kLastChirp = 600;              // [Hz]
constexpr double kThrustShare = 0.4;  // of f_max: its negative stiffness is the larger one

Excitation Signal(const std::string& target, const std::string& port, const std::string& kind,
                  double start, double stop, double amplitude) {
  Excitation e;
  e.target = target;
  e.port = port;
  e.kind = kind;
  e.start = start;
  e.stop = stop;
  e.amplitude = amplitude;
  return e;
}

/// Three tones of coil k of all n, spread over the band so that no two coils share one.
void AddTones(const RigParameters& rig, const CommissioningPlan& plan, Scenario* s) {
  std::size_t coils = 0, k = 0;
  for (const int n : CoilsOf(rig)) coils += static_cast<std::size_t>(n);
  const double ratio =
      std::pow(kHighestTone / kLowestTone, 1.0 / (3.0 * static_cast<double>(coils)));
  for (const BearingParameters& b : rig.bearings)
    for (int j = 0; j < b.coils(); ++j, ++k) {
      Excitation e = Signal(CoilName(b.name, j), "current", "multisine", 0.15 * plan.duration,
                            0.45 * plan.duration, plan.current);
      for (std::size_t tone = 0; tone < 3; ++tone) {
        e.frequencies.push_back(kLowestTone *
                                std::pow(ratio, static_cast<double>(tone * coils + k)));
        e.phases.push_back(2.0 * static_cast<double>(k * (tone + 1)));
      }
      s->excitations.push_back(e);
    }
}

/// Currents that move the potential of a floating rotor and nothing else: s_j i_j of all
/// coils alike, no flux, no force. Only they tell leakage past the rotor from fringing into it.
void AddPotentialChirp(const RigParameters& rig, const CommissioningPlan& plan, Scenario* s) {
  for (const BearingParameters& b : rig.bearings) {
    const StatorGeometry stator = b.kind->stator(b);
    if (stator.coupling != Coupling::kFloatingRotor) continue;
    const double amplitude = plan.potential * BiasCurrent(rig, b);
    for (int j = 0; j < b.coils(); ++j) {
      Excitation e = Signal(CoilName(b.name, j), "current", "chirp", 0.15 * plan.duration,
                            0.6 * plan.duration, stator.n[j] < 0 ? -amplitude : amplitude);
      e.f0 = kFirstPotential * rig.amplifier.switching_frequency;
      e.f1 = kLastPotential * rig.amplifier.switching_frequency;
      s->excitations.push_back(e);
    }
  }
}

void AddCircles(const RigParameters& rig, const CommissioningPlan& plan, Scenario* s) {
  const double begin = 0.3 * plan.duration, middle = 0.475 * plan.duration,
               end = 0.65 * plan.duration;
  bool second_plane = false;
  for (const BearingParameters& b : rig.bearings) {
    const auto axes = b.Axes();
    const double share = b.kind->axial ? kThrustShare : 1;
    for (std::size_t a = 0; a < axes.size(); ++a)
      for (int part = 0; part < 2; ++part) {
        Excitation e = Signal(axes[a], "reference", "sine", part == 0 ? begin : middle,
                              part == 0 ? middle : end, share * plan.circle * ClearanceOf(b));
        e.frequency = std::min(kCircleTurns / (middle - begin), kFastestCircle);
        e.phase = a == 0 ? 0 : 0.5 * kPi;
        if (part == 1 && second_plane) e.phase += kPi;
        s->excitations.push_back(e);
      }
    second_plane = second_plane || b.kind->two_axes;
  }
}

void AddForces(const RigParameters& rig, const CommissioningPlan& plan, Scenario* s) {
  const double begin = 0.6 * plan.duration, middle = 0.85 * plan.duration;
  std::size_t axis = 0;
  for (const BearingParameters& b : rig.bearings) {
    const double share = b.kind->axial ? kThrustShare : 1;
    const double f_max = share * PidOf(rig, b).f_max;
    for (const std::string& name : b.Axes()) {
      Excitation chirp = Signal(name, "force", "chirp", begin, middle, plan.chirp * f_max);
      chirp.f0 = kFirstChirp;
      chirp.f1 = kLastChirp;
      chirp.phase = 0.7 * static_cast<double>(axis);
      s->excitations.push_back(chirp);
      // Up, down, alternating over the axes: both directions of each.
      const double length = 0.15 * plan.duration / 4;
      for (int k = 0; k < 2; ++k) {
        const double at = middle + length * (2 * k + (axis % 2));
        s->excitations.push_back(Signal(name, "force", "pulse", at, at + 0.5 * length,
                                        (k == 0 ? 1 : -1) * plan.pulse * f_max));
      }
      ++axis;
    }
  }
}

}  // namespace

Scenario CommissioningScenario(const RigParameters& rig, const CommissioningPlan& plan) {
  if (rig.amplifier.modulation != Modulation::kBiState)
    throw InputError(
        fmt::format("{}: allowed for commissioning: a rig with bi-state bridges "
                    "(slopes need both phases)",
                    rig.file));
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->linearise)
      throw InputError(
          fmt::format("{}: bearing {}: kind = \"{}\", allowed for commissioning: "
                      "radial, thrust, opposed",
                      rig.file, b.name, b.kind->name));
  Scenario s;
  s.name = "commissioning";
  s.rig_file = rig.file;
  s.duration = plan.duration;
  s.record_rate = 1000;
  s.seed = plan.seed;
  s.fault_tolerant = false;
  s.start = StartState::kLevitated;
  s.speed = SpeedProfile({{0.0, 0.0}, {0.55 * plan.duration, 0.0}, {plan.duration, plan.speed}});
  AddTones(rig, plan, &s);
  AddPotentialChirp(rig, plan, &s);
  AddCircles(rig, plan, &s);
  AddForces(rig, plan, &s);
  return s;
}

}  // namespace ambrig
