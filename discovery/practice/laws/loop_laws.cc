/// Hysteresis with other spreads of its operators than the catalogue's: most in narrow loops, or
/// two populations (effects/play_hysteresis.cc).
#include <cmath>

#include "discovery/practice/laws/practice_law.h"
#include "effects/law_tables.h"

namespace ambrig {

namespace {

EffectInstance Operators(const LawSetting& s, double width, const double* share, double size) {
  std::vector<std::pair<std::string, double>> values{{"width", width}};
  double sum = 0;
  for (int k = 0; k < kPlayOperators; ++k) sum += share[k];
  for (int k = 0; k < kPlayOperators; ++k)
    values.emplace_back("c" + std::to_string(k + 1), size * share[k] / sum);
  return CatalogueEffect("play-hysteresis", s.target, values);
}

std::vector<EffectInstance> Narrow(LawSetting s) {
  const double width = s.draw.Log(0.2, 0.6), fall = s.draw.Between(0.3, 1);
  double share[kPlayOperators];
  for (int k = 0; k < kPlayOperators; ++k) share[k] = std::exp(-fall * k);
  return {Operators(s, width, share, 0.05 * s.size)};
}

std::vector<EffectInstance> TwoWidths(LawSetting s) {
  const double width = s.draw.Log(0.3, 0.7), share_of_wide = s.draw.Between(0.3, 0.7);
  const auto wide = 5 + s.draw.Of(3);
  double share[kPlayOperators] = {};
  share[2 + s.draw.Of(2)] = 1 - share_of_wide;  // a seventh or a quarter of the width
  share[wide] = share_of_wide;
  return {Operators(s, width, share, 0.05 * s.size)};
}

}  // namespace

std::vector<PracticeLaw> LoopLaws() {
  return {{"hysteresis-narrow", "loops of many widths", "hysteresis", "hysteresis", Narrow},
          {"hysteresis-two-widths", "loops of two widths", "hysteresis", "hysteresis", TwoWidths}};
}

}  // namespace ambrig
