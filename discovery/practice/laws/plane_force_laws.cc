/// Forces at a plane that depend on where the rotor is: cross-coupling that grows with the speed
/// and damps, or falls off with the orbit; magnetic pull that hardens towards the stator or differs
/// between the axes; rotating damping that depends on the size of the motion; loads that swing.
#include <fmt/format.h>

#include <cmath>

#include "discovery/practice/laws/practice_law.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

/// A stiffness that a rig of this size feels [N/m].
double Stiffness(const LawSetting& s) { return 0.1 * s.weight / s.reach * s.size; }

std::vector<EffectInstance> CrossOfSpeed(LawSetting s) {
  const double k = s.draw.Sign() * Stiffness(s), share = s.draw.Between(0.15, 0.5),
               speed = s.draw.Log(400, 1500), c = std::abs(k) * s.draw.Log(1e-4, 8e-4);
  const std::string size =
      fmt::format("({} + {} * omega / {})", Digits(k * (1 - share)), Digits(k * share), speed);
  return {FormulaAt(s.target, {{"force.x", fmt::format("-{} * y - {} * vx", size, Digits(c))},
                               {"force.y", fmt::format("{} * x - {} * vy", size, Digits(c))}})};
}

std::vector<EffectInstance> CrossFallingOff(LawSetting s) {
  const double k = s.draw.Sign() * Stiffness(s), knee = s.reach * s.draw.Log(0.15, 0.5);
  const std::string size =
      fmt::format("({} / (1 + (x * x + y * y) / {}))", Digits(k), Digits(knee * knee));
  return {FormulaAt(s.target, {{"force.x", "-" + size + " * y"}, {"force.y", size + " * x"}})};
}

std::vector<EffectInstance> PullHardening(LawSetting s) {
  const double k = 0.5 * Stiffness(s), gap = s.reach * s.draw.Between(2, 4),
               ex = s.reach * s.draw.Between(-0.05, 0.05),
               ey = s.reach * s.draw.Between(-0.05, 0.05);
  const std::string grown = fmt::format("({} / (1 - min(0.6, ((x - {}) ^ 2 + (y - {}) ^ 2) / {})))",
                                        Digits(k), Digits(ex), Digits(ey), Digits(gap * gap));
  return {FormulaAt(s.target, {{"force.x", fmt::format("{} * (x - {})", grown, Digits(ex))},
                               {"force.y", fmt::format("{} * (y - {})", grown, Digits(ey))}})};
}

std::vector<EffectInstance> PullOfTwoAxes(LawSetting s) {
  const double k = 0.5 * Stiffness(s), ratio = s.draw.Between(0.6, 0.85);
  return {FormulaAt(s.target,
                    {{"force.x", Digits(k) + " * x"}, {"force.y", Digits(k * ratio) + " * y"}})};
}

std::vector<EffectInstance> RotatingDamping(LawSetting s) {
  const double d = 0.03 * s.weight / s.reach / 500 * s.size, knee = s.reach * s.draw.Log(0.1, 0.5);
  std::vector<EffectInstance> out;
  const std::string size =
      fmt::format("({} / (1 + sqrt(x * x + y * y) / {}))", Digits(d), Digits(knee));
  for (const BearingParameters& b : s.rig.bearings)
    if (b.kind->two_axes)
      out.push_back(FormulaAt(b.name, {{"force.x", "-" + size + " * (vx + omega * y)"},
                                       {"force.y", "-" + size + " * (vy - omega * x)"}}));
  return out;
}

std::vector<EffectInstance> SwingingLoad(LawSetting s) {
  const double f = 0.05 * s.weight * s.size, angle = s.draw.Between(-3, 3),
               swing = s.draw.Between(0.1, 0.25), w = 6.28 * s.draw.Log(0.5, 3);
  const std::string now = fmt::format("(1 + {} * sin({} * t))", swing, w);
  return {FormulaAt(s.target, {{"force.x", Digits(f * std::cos(angle)) + " * " + now},
                               {"force.y", Digits(f * std::sin(angle)) + " * " + now}})};
}

}  // namespace

std::vector<PracticeLaw> PlaneForceLaws() {
  return {{"cross-of-speed", "cross-coupling of the speed", "cross-coupling", "cross-coupling",
           CrossOfSpeed},
          {"cross-falling-off", "cross-coupling of the orbit", "cross-coupling", "cross-coupling",
           CrossFallingOff},
          {"pull-hardening", "pull that hardens", "side-pull", "cross-coupling", PullHardening},
          {"pull-of-two-axes", "pull of two sizes", "side-pull", "cross-coupling", PullOfTwoAxes},
          {"rotating-damping-soft", "damping of the orbit", "rotating-damping", "rotating-damping",
           RotatingDamping},
          {"load-swinging", "load that swings", "constant-load", "cross-coupling", SwingingLoad}};
}

}  // namespace ambrig
