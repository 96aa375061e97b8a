/// Structures with more than one mode: a base whose second mode is weak, a shaft with two bending
/// modes or of another shape than the uniform rod's, a floor that shakes with harmonics, a bow
/// beside a surface of second order.
#include <cmath>

#include "discovery/practice/laws/practice_law.h"

namespace ambrig {

namespace {

std::vector<EffectInstance> BaseOfTwoModes(LawSetting s) {
  const double f = s.draw.Log(25, 120), mass = s.weight / 9.81 * 10 / s.size,
               second = f * s.draw.Between(3.2, 6), gain = 0.06 / std::sqrt(s.weight / 9.81);
  return {CatalogueEffect("base-mode", "rig",
                          {{"mass", mass}, {"frequency", f}, {"damping", s.draw.Log(0.01, 0.06)}}),
          CatalogueEffect("bending-mode", "rig",
                          {{"frequency", second},
                           {"damping", 0.05},
                           {"gain_a", gain},
                           {"gain_b", gain * s.draw.Between(0.7, 1.3)}})};
}

std::vector<EffectInstance> TwoBendingModes(LawSetting s) {
  const double f = s.draw.Log(180, 700), mass = s.weight / 9.81,
               gain = 0.5 / std::sqrt(mass) * s.size, sign = s.draw.Sign();
  return {CatalogueEffect("bending-mode", "rig",
                          {{"frequency", f},
                           {"damping", s.draw.Log(0.003, 0.02)},
                           {"gain_a", gain},
                           {"gain_b", sign * gain * s.draw.Between(0.5, 1.2)},
                           {"gyro", s.draw.Between(0, 0.25)},
                           {"length", s.draw.Between(0.85, 1.2)}}),
          CatalogueEffect("bending-mode", "rig",
                          {{"frequency", f * s.draw.Between(2.4, 3)},
                           {"damping", 0.01},
                           {"gain_a", 0.3 * gain},
                           {"gain_b", -sign * 0.3 * gain}})};
}

std::vector<EffectInstance> BentRodOfOtherShape(LawSetting s) {
  const double gain = 0.5 / std::sqrt(s.weight / 9.81) * s.size;
  return {CatalogueEffect(
      "bending-mode", "rig",
      {{"frequency", s.draw.Log(120, 900)},
       {"damping", s.draw.Log(0.002, 0.03)},
       {"gain_a", gain},
       {"gain_b", s.draw.Sign() * gain * s.draw.Between(0.3, 1.5)},
       {"gyro", s.draw.Between(-0.3, 0.3)},
       {"length", s.draw.Sign() < 0 ? s.draw.Between(0.7, 0.85) : s.draw.Between(1.15, 1.4)}})};
}

std::vector<EffectInstance> FloorWithHarmonics(LawSetting s) {
  const double f = s.draw.Log(12, 90), a = 0.3 * s.size, phase = s.draw.Between(-3, 3),
               second = s.draw.Between(0.1, 0.3);
  return {CatalogueEffect("base-vibration", "rig",
                          {{"frequency", f},
                           {"cx", a * std::cos(phase)},
                           {"sx", a * std::sin(phase)},
                           {"cy", 0.6 * a * std::sin(phase)},
                           {"sy", 0.6 * a * std::cos(phase)}}),
          CatalogueEffect("base-vibration", "rig",
                          {{"frequency", 2 * f}, {"cx", second * a}, {"sy", second * a}})};
}

}  // namespace

std::vector<PracticeLaw> StructureLaws() {
  return {
      {"base-of-two-modes", "base of two modes", "base-mode", "base-mode", BaseOfTwoModes},
      {"bending-two-modes", "shaft of two modes", "bending-mode", "bending-mode", TwoBendingModes},
      {"bending-other-shape", "shaft of another shape", "bending-mode", "bending-mode",
       BentRodOfOtherShape},
      {"floor-with-harmonics", "floor with harmonics", "base-vibration", "base-vibration",
       FloorWithHarmonics}};
}

}  // namespace ambrig
