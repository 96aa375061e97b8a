#include "rig/amplifier_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kMostBandwidth = 0.1;  // of the switching frequency
// kp T/L of a loop that is fed the mean of the last period is unstable from 2 on.
constexpr double kMostGain = 1.75;
constexpr double kMostJitter = 0.1;  // of the time between two ADC samples

/// What closes the loop round a coil: gains, a bandwidth that they follow from, or nothing.
void ReadLoopOfAmplifier(const TomlTable& t, AmplifierParameters& a) {
  a.voltage_mode = t.Choice("mode", "current", "current, voltage") == "voltage";
  t.Read(a, kAmplifierModeFields);
  if (a.voltage_mode) {
    a.ki = 0;
    for (const char* key : {"ki", "bandwidth"})
      if (t.Has(key) && t.Number(key) != 0)
        t.Fail(key, "of an amplifier in voltage mode, allowed: none (kp is its gain in V/A)");
    return;
  }
  if (a.bandwidth == 0) return;
  for (const char* key : {"kp", "ki"})
    if (t.Has(key)) t.Fail(key, "stands beside bandwidth, allowed: one of the two");
  a.kp = a.ki = 0;
}

}  // namespace

void TuneAmplifier(const TomlTable& t, RigParameters& rig) {
  AmplifierParameters& a = rig.amplifier;
  if (a.bandwidth == 0) return;
  if (a.bandwidth > kMostBandwidth * a.switching_frequency)
    t.Fail("bandwidth", fmt::format("= {} Hz, allowed: at most {} Hz, a tenth of the switching "
                                    "frequency",
                                    a.bandwidth, kMostBandwidth * a.switching_frequency));
  double inductance = 0, resistance = 0;
  for (const BearingParameters& b : rig.bearings) {
    const double L = LargestInductance(b);
    if (L > inductance) resistance = CoilResistance(b);
    inductance = std::max(inductance, L);
  }
  a.kp = 2 * kPi * a.bandwidth * inductance;
  a.ki = 2 * kPi * a.bandwidth * resistance;
  for (const BearingParameters& b : rig.bearings) {
    const double most = kMostGain * a.switching_frequency * LeastInductance(b);
    if (a.kp > most)
      t.Fail("bandwidth",
             fmt::format(
                 "= {} Hz of {:.3g} H, allowed: at most {:.4g} Hz, for bearing {} has a pattern "
                 "of currents with {:.3g} H only",
                 a.bandwidth, inductance, a.bandwidth * most / a.kp, b.name, LeastInductance(b)));
  }
}

void ReadAmplifier(const TomlTable& t, RigParameters& rig) {
  AmplifierParameters& a = rig.amplifier;
  const std::string m = t.Choice("modulation", "bi-state", kModulations);
  a.modulation = m == "bi-state" || m == "two-level" ? Modulation::kBiState
                 : m == "tri-state" || m == "three-level" || m == "interleaved"
                     ? Modulation::kTriState
                 : m == "chopper" ? Modulation::kChopper
                                  : Modulation::kIdeal;
  ReadLoopOfAmplifier(t, a);
  t.Read(a, kAmplifierFields, &rig.tolerances);
  t.Read(a, kAmplifierErrorFields);
  if (m == "linear") a.duty_min = -1, a.duty_max = 1;
  const auto limits = t.Numbers("duty_limits", {a.duty_min, a.duty_max});
  const bool any_sign = a.modulation == Modulation::kIdeal;
  const char* bounds = any_sign ? "-1 to 1" : "0 to 1";
  if (limits.size() != 2 || !(limits[0] >= -1 && limits[0] < limits[1] && limits[1] <= 1))
    t.Fail("duty_limits", fmt::format("allowed: [min, max] with min < max, within {}", bounds));
  a.duty_min = limits[0];
  a.duty_max = limits[1];
  if (a.duty_min < 0 && !any_sign) t.Fail("duty_limits", "allowed: 0 to 1 for a switching bridge");
  for (const char* key : {"adc_samples_per_period", "adc_bits", "quadrants", "unit"}) {
    const double v = t.Number(key, 2);
    if (v != std::floor(v)) t.Fail(key, fmt::format("= {}, allowed: an integer", v));
  }
  const double most = kMostJitter / (a.switching_frequency * a.adc_samples_per_period);
  if (a.adc_jitter > most)
    t.Fail("adc_jitter",
           fmt::format("= {} s, allowed: at most {:.3g} s, a tenth of the time between samples",
                       a.adc_jitter, most));
  if (a.quadrants == 3) t.Fail("quadrants", "= 3, allowed: 2 or 4");
  if (a.i_max > a.adc_range)
    t.Fail("i_max", fmt::format("= {} A, allowed: at most adc_range = {} A", a.i_max, a.adc_range));
  t.RejectUnknownKeys();
}

}  // namespace ambrig
