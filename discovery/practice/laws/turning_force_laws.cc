/// Forces that turn with the rotor: an unbalance that grows with time (heat, deposits) or answers
/// the axes differently, a coupling with other orders beside the second, drag of another power.
#include <fmt/format.h>

#include <cmath>

#include "discovery/practice/laws/practice_law.h"

namespace ambrig {

namespace {

constexpr double kUsualSpeed = 1000;  // [rad/s]

std::vector<EffectInstance> GrowingUnbalance(LawSetting s) {
  const double u = 0.1 * s.weight / (kUsualSpeed * kUsualSpeed) * s.size,
               phase = s.draw.Between(-3, 3), rate = s.draw.Sign() * s.draw.Between(0.2, 0.6);
  const std::string size = fmt::format("({} * (1 + {} * t) * omega ^ 2)", Digits(u), Digits(rate));
  return {
      FormulaAt(s.target, {{"force.x", fmt::format("{} * cos(theta + {})", size, Digits(phase))},
                           {"force.y", fmt::format("{} * sin(theta + {})", size, Digits(phase))}})};
}

std::vector<EffectInstance> TwoPlanesOfUnbalance(LawSetting s) {
  const double u = 0.1 * s.weight / (kUsualSpeed * kUsualSpeed) * s.size,
               phase = s.draw.Between(-3, 3), power = s.draw.Between(1.8, 2.2);
  const std::string size = fmt::format("({} * (omega / {}) ^ {})",
                                       Digits(u * kUsualSpeed * kUsualSpeed), kUsualSpeed, power);
  return {
      FormulaAt(s.target, {{"force.x", fmt::format("{} * cos(theta + {})", size, Digits(phase))},
                           {"force.y", fmt::format("{} * sin(theta + {})", size, Digits(phase))}})};
}

std::vector<EffectInstance> CouplingOrders(LawSetting s) {
  const double f = 0.05 * s.weight * s.size, phase = s.draw.Between(-3, 3),
               back = s.draw.Between(0.1, 0.3), first = s.draw.Between(0.1, 0.3),
               fourth = s.draw.Between(0.05, 0.2);
  const auto along = [&](const char* fn, double sign) {
    return fmt::format(
        "{0} * ({1}(2 * theta + {2}) + {3} * {1}(2 * theta) + {4} * {1}(theta) + "
        "{5} * {1}(4 * theta))",
        Digits(f), fn, Digits(phase), Digits(sign * back), Digits(first), Digits(fourth));
  };
  return {FormulaAt(s.target, {{"force.x", along("cos", 1)}, {"force.y", along("sin", -1)}})};
}

std::vector<EffectInstance> Drag(LawSetting s) {
  const double power = s.draw.Between(1.4, 2.7);
  const double torque = 3 * s.rig.rotor.inertia_polar * s.size * kUsualSpeed * 0.1;
  return {FormulaAt("rig", {{"torque", fmt::format("-{} * sign(omega) * (abs(omega) / {}) ^ {}",
                                                   Digits(torque), kUsualSpeed, power)}})};
}

}  // namespace

std::vector<PracticeLaw> TurningForceLaws() {
  return {{"unbalance-growing", "unbalance that grows", "unbalance", "cross-coupling",
           GrowingUnbalance},
          {"unbalance-power", "unbalance of another power", "unbalance", "cross-coupling",
           TwoPlanesOfUnbalance},
          {"coupling-orders", "coupling of many orders", "coupling-misalignment", "cross-coupling",
           CouplingOrders},
          {"windage-power", "drag of another power", "windage", "windage", Drag}};
}

}  // namespace ambrig
