/// Physics that the catalogue lacks; the right verdict is "unknown". A rub at one clock position, a
/// force that turns many times a revolution, friction of Coulomb with a Stribeck drop, a spring
/// with play, readings that see a current, a shaft of two stiffnesses, blows at intervals.
#include <fmt/format.h>

#include <cmath>

#include "discovery/practice/laws/practice_law.h"

namespace ambrig {

namespace {

double Spring(const LawSetting& s) { return 0.5 * s.weight / s.reach * s.size; }

std::vector<EffectInstance> Rub(LawSetting s) {
  const double angle = s.draw.Between(-3, 3), k = 10 * Spring(s),
               edge = s.reach * s.draw.Between(-0.02, 0.02), mu = s.draw.Between(0.1, 0.4),
               c = std::cos(angle), n = std::sin(angle);
  const std::string depth =
      fmt::format("({} * x + {} * y - {})", Digits(c), Digits(n), Digits(edge));
  const auto push = [&](double along) {
    return fmt::format("{0} > 0 ? {1} * {0} : 0", depth, Digits(-k * along));
  };
  return {FormulaAt(s.target, {{"force.x", push(c - mu * n)}, {"force.y", push(n + mu * c)}})};
}

std::vector<EffectInstance> Cogging(LawSetting s) {
  const double f = 0.05 * s.weight * s.size, phase = s.draw.Between(-3, 3);
  const std::size_t order = 5 + s.draw.Of(5);
  return {FormulaAt(
      s.target,
      {{"force.x", fmt::format("{} * cos({} * theta + {})", Digits(f), order, Digits(phase))},
       {"force.y", fmt::format("{} * sin({} * theta + {})", Digits(f), order, Digits(phase))}})};
}

std::vector<EffectInstance> Friction(LawSetting s) {
  const double f = 0.03 * s.weight * s.size, v0 = s.reach * s.draw.Log(2, 10),
               extra = s.draw.Between(0.2, 0.8), vs = v0 * s.draw.Log(2, 6);
  const auto along = [&](const char* v) {
    return fmt::format("{1} * tanh({0} / {2}) * (1 + {3} * exp(-({0} / {4}) ^ 2))", v, Digits(-f),
                       Digits(v0), extra, Digits(vs));
  };
  return {FormulaAt(s.target, {{"force.x", along("vx")}, {"force.y", along("vy")}})};
}

std::vector<EffectInstance> Play(LawSetting s) {
  const double k = 2 * Spring(s), play = s.reach * s.draw.Log(0.01, 0.06);
  const auto along = [&](const char* u) {
    return fmt::format("abs({0}) > {1} ? {2} * ({0} - sign({0}) * {1}) : 0", u, Digits(play),
                       Digits(-k));
  };
  return {FormulaAt(s.target, {{"force.x", along("x")}, {"force.y", along("y")}})};
}

std::vector<EffectInstance> Crosstalk(LawSetting s) {
  const double per_ampere = s.draw.Sign() * 0.01 * s.reach * s.size;
  const std::size_t coil = 1 + s.draw.Of(4), other = 1 + s.draw.Of(4);
  return {FormulaAt(
      s.target,
      {{"reading.x", fmt::format("x + {} * (i{} - 2)", Digits(per_ampere), coil)},
       {"reading.y", fmt::format("y + {} * (i{} - 2)", Digits(0.7 * per_ampere), other)}})};
}

std::vector<EffectInstance> TwoStiffnesses(LawSetting s) {
  const double k = 0.3 * Spring(s), phase = s.draw.Between(-3, 3);
  const auto turned = [&](const char* fn) {
    return fmt::format("{}(2 * theta + {})", fn, Digits(phase));
  };
  return {FormulaAt(
      s.target,
      {{"force.x", fmt::format("{} * (x * {} + y * {})", Digits(k), turned("cos"), turned("sin"))},
       {"force.y",
        fmt::format("{} * (x * {} - y * {})", Digits(k), turned("sin"), turned("cos"))}})};
}

std::vector<EffectInstance> Blows(LawSetting s) {
  const double f = 0.3 * s.weight * s.size, every = s.draw.Log(0.03, 0.1),
               width = s.draw.Log(5e-4, 3e-3), angle = s.draw.Between(-3, 3);
  const std::string now =
      fmt::format("exp(-((t - {0} * rint(t / {0})) / {1}) ^ 2)", Digits(every), Digits(width));
  return {FormulaAt(s.target, {{"force.x", Digits(f * std::cos(angle)) + " * " + now},
                               {"force.y", Digits(f * std::sin(angle)) + " * " + now}})};
}

}  // namespace

std::vector<PracticeLaw> UnknownLaws() {
  return {{"rub", "rub at one place", "", "cross-coupling", Rub},
          {"cogging", "force of a high order", "", "cross-coupling", Cogging},
          {"stribeck-friction", "dry friction", "", "cross-coupling", Friction},
          {"spring-with-play", "spring with play", "", "cross-coupling", Play},
          {"crosstalk", "reading of a current", "", "cross-coupling", Crosstalk},
          {"two-stiffnesses", "shaft of two stiffnesses", "", "cross-coupling", TwoStiffnesses},
          {"blows", "blows at intervals", "", "cross-coupling", Blows}};
}

}  // namespace ambrig
