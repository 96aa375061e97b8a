/// Position sensors whose error has another form: a gain that bends or differs between the two
/// directions, axes that are not square to each other, a zero that drifts, hum that comes and goes,
/// a dent in the surface, electronics of second order.
#include <fmt/format.h>

#include <cmath>

#include "discovery/practice/laws/practice_law.h"

namespace ambrig {

namespace {

/// "A.x": plane "A" and "x". A thrust axis has no side.
std::string PlaneOf(const std::string& axis) { return axis.substr(0, axis.find('.')); }
std::string SideOf(const std::string& axis) { return axis.substr(axis.find('.') + 1); }

std::vector<EffectInstance> BentGain(LawSetting s) {
  const double gain = 1 + s.draw.Sign() * 0.04 * s.size,
               square = s.draw.Sign() * s.draw.Between(0.02, 0.08) / s.reach,
               cube = s.draw.Sign() * s.draw.Between(0.02, 0.1) / (s.reach * s.reach);
  const std::string u = SideOf(s.target);
  return {FormulaAt(
      PlaneOf(s.target),
      {{"reading." + u, fmt::format("{1} * {0} + {2} * {0} ^ 2 + {3} * {0} ^ 3", u, Digits(gain),
                                    Digits(square * (gain - 1)), Digits(cube * (gain - 1)))}})};
}

std::vector<EffectInstance> TwoGains(LawSetting s) {
  const double sign = s.draw.Sign(), share = s.draw.Between(0.5, 0.8);
  const std::string u = SideOf(s.target);
  return {FormulaAt(PlaneOf(s.target),
                    {{"reading." + u, fmt::format("{0} > 0 ? {1} * {0} : {2} * {0}", u,
                                                  Digits(1 + sign * 0.04 * s.size),
                                                  Digits(1 + sign * 0.04 * s.size * share))}})};
}

std::vector<EffectInstance> SkewAxes(LawSetting s) {
  const double a = s.draw.Sign() * 0.04 * s.size, b = a * s.draw.Between(0.6, 0.85);
  return {FormulaAt(
      s.target,
      {{"reading.x", fmt::format("{} * x + {} * y", Digits(std::cos(a)), Digits(std::sin(a)))},
       {"reading.y", fmt::format("{} * y - {} * x", Digits(std::cos(b)), Digits(std::sin(b)))}})};
}

std::vector<EffectInstance> DriftingZero(LawSetting s) {
  const double zero = s.draw.Sign() * 0.05 * s.reach * s.size, rate = s.draw.Between(0.1, 0.4);
  const std::string u = SideOf(s.target);
  return {FormulaAt(
      PlaneOf(s.target),
      {{"reading." + u, fmt::format("{} + {} * (1 + {} * t)", u, Digits(zero), Digits(rate))}})};
}

std::vector<EffectInstance> WaxingHum(LawSetting s) {
  const double size = 0.02 * s.reach * s.size, w = s.draw.Sign() < 0 ? 314.159265 : 376.991118,
               swing = s.draw.Between(0.1, 0.3), slow = 6.28 * s.draw.Log(0.7, 4),
               second = s.draw.Between(0.05, 0.2), third = s.draw.Between(0, 0.4),
               phase = s.draw.Between(-3, 3);
  const std::string hum = fmt::format(
      "{0} * (1 + {1} * sin({2} * t)) * (cos({3} * t + {4}) + {5} * cos(2 * {3} * t) + {6} * cos(3 "
      "* {3} * t))",
      Digits(size), swing, slow, Digits(w), Digits(phase), second, third);
  return {FormulaAt(s.target, {{"reading.x", "x + " + hum}, {"reading.y", "y + " + hum}})};
}

/// A dent of the surface passes the probes of x and y a quarter of a turn apart. Less its mean over
/// a turn, which would be a zero of both sensors, another effect.
std::vector<EffectInstance> Dent(LawSetting s) {
  const double depth = 0.04 * s.reach * s.size, narrow = s.draw.Log(0.7, 4),
               place = s.draw.Between(-3, 3),
               mean = std::exp(-narrow) * std::cyl_bessel_i(0.0, narrow);
  const auto dent = [&](double probe) {
    return fmt::format("{} * (exp({} * (cos(theta - {}) - 1)) - {})", Digits(-depth), narrow,
                       Digits(place + probe), Digits(mean));
  };
  return {FormulaAt(s.target,
                    {{"reading.x", "x + " + dent(0)}, {"reading.y", "y + " + dent(1.5707963)}})};
}

std::vector<EffectInstance> SecondOrder(LawSetting s) {
  const double cutoff = 4e3 / s.size, ratio = s.draw.Log(1, 3);
  return {CatalogueEffect("sensor-lowpass", s.target, {{"cutoff", cutoff}}),
          CatalogueEffect("sensor-lowpass", s.target, {{"cutoff", cutoff * ratio}})};
}

}  // namespace

std::vector<PracticeLaw> ReadingLaws() {
  return {{"gain-bent", "gain that bends", "sensor-gain", "sensor-gain", BentGain},
          {"gain-of-two-sides", "gain of two sides", "sensor-gain", "sensor-gain", TwoGains},
          {"axes-skew", "axes that are not square", "sensor-rotation", "sensor-rotation", SkewAxes},
          {"zero-drifting", "zero that drifts", "sensor-offset", "sensor-offset", DriftingZero},
          {"hum-waxing", "hum that comes and goes", "sensor-hum", "sensor-hum", WaxingHum},
          {"runout-dent", "dent in the surface", "sensor-runout", "sensor-runout", Dent},
          {"lowpass-second-order", "electronics of second order", "sensor-lowpass",
           "sensor-lowpass", SecondOrder}};
}

}  // namespace ambrig
