/// Amplifiers and supplies: an offset that depends on the current as the voltage of a junction
/// does, current sensors with an error of two kinds at once, a source that is slower than the
/// catalogue's beside a dead time.
#include <fmt/format.h>

#include <cmath>

#include "core/base/coil_name.h"
#include "discovery/practice/laws/practice_law.h"

namespace ambrig {

namespace {

std::vector<EffectInstance> OffsetOfCurrent(LawSetting s) {
  // A junction's voltage grows with the logarithm of its current. The catalogue's law is a line:
  // offset and resistance.
  const double u = s.draw.Sign() * 0.5 * s.size, share = s.draw.Between(0.3, 0.9),
               knee = s.draw.Log(0.3, 2);
  const std::string law =
      fmt::format("{} * (1 + {} * ln(1 + abs(i) / {}))", Digits(u), Digits(share), Digits(knee));
  const BearingParameters* whole = s.rig.Find(s.target);
  if (!whole) return {FormulaAt(s.target, {{"voltage", law}})};
  std::vector<EffectInstance> out;  // each coil's own current
  for (int j = 0; j < whole->coils(); ++j)
    out.push_back(FormulaAt(CoilName(s.target, j), {{"voltage", law}}));
  return out;
}

std::vector<EffectInstance> SensorOfTwoErrors(LawSetting s) {
  const double gain = s.draw.Sign() * 0.02 * s.size, zero = s.draw.Sign() * 0.1 * gain;
  return {CatalogueEffect("current-sensor-gain", s.target, {{"gain", 1 + gain}}),
          CatalogueEffect("current-sensor-offset", s.target, {{"offset", zero}})};
}

std::vector<EffectInstance> ZeroWithGain(LawSetting s) {
  const double zero = s.draw.Sign() * 0.05 * s.size;
  return {CatalogueEffect("current-sensor-offset", s.target, {{"offset", zero}}),
          CatalogueEffect("current-sensor-gain", s.target, {{"gain", 1 + 0.04 * zero}})};
}

std::vector<EffectInstance> DelayAndFilter(LawSetting s) {
  const double period = 1 / s.rig.amplifier.switching_frequency;
  const double periods = std::max(1.0, std::round(s.draw.Between(1, 3) * s.size));
  return {CatalogueEffect("loop-delay", "rig", {{"time", periods * period}}),
          CatalogueEffect("sensor-lowpass", "rig", {{"cutoff", s.draw.Log(2e4, 6e4)}})};
}

}  // namespace

std::vector<PracticeLaw> ElectricLaws() {
  return {
      {"offset-of-current", "offset of the current", "amplifier-offset", "current-sensor-gain",
       OffsetOfCurrent},
      {"current-gain-and-zero", "current sensors of two errors", "current-sensor-gain",
       "current-sensor-gain", SensorOfTwoErrors},
      {"current-zero-and-gain", "current sensors of two errors", "current-sensor-offset",
       "current-sensor-offset", ZeroWithGain},
      {"delay-and-filter", "delay beside a filter", "loop-delay", "loop-delay", DelayAndFilter}};
}

}  // namespace ambrig
