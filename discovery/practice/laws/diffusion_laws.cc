/// Eddy currents of other orders than one half: a fractional order as a sum of relaxations
/// (effects/eddy_impedance.cc), two sheet thicknesses in one core, one closed ring.
///   (s/w)^a = sin(a pi)/pi ∫ (p/w)^a s/(s + p) d ln p,  poles half a decade apart
/// Source: docs/theory/published_values.md 7 (orders between 0.4 and 0.7 are measured); the
/// integral is that of Cole and Cole 1941 for a power of s.
#include <cmath>

#include "core/math/constants.h"
#include "discovery/practice/laws/practice_law.h"
#include "effects/law_tables.h"

namespace ambrig {

namespace {

std::vector<EffectInstance> OtherOrder(LawSetting s) {
  const double order = s.draw.Sign() < 0 ? s.draw.Between(0.32, 0.43) : s.draw.Between(0.57, 0.72);
  const double cutoff = s.draw.Log(1e3, 2e4);
  std::vector<std::pair<std::string, double>> values;
  for (int k = 0; k < kRelaxations; ++k)
    values.emplace_back("r" + std::to_string(k + 1),
                        s.size * std::pow(RelaxationFrequency(k) / cutoff, order) *
                            std::sin(order * kPi) / kPi * 0.5 * std::log(10.0));
  return {CatalogueEffect("eddy-impedance", s.target, values)};
}

std::vector<EffectInstance> TwoSheets(LawSetting s) {
  const double thin = s.draw.Log(4e3, 3e4), ratio = s.draw.Log(3, 12),
               path = s.draw.Log(5e-6, 3e-5);
  const double cutoff = thin / (s.size * s.size);
  return {CatalogueEffect("eddy-currents", s.target, {{"cutoff", cutoff}, {"path", path}}),
          CatalogueEffect("eddy-currents", s.target,
                          {{"cutoff", cutoff * ratio}, {"path", path / ratio}})};
}

std::vector<EffectInstance> Ring(LawSetting s) {
  const auto k = 3 + s.draw.Of(5);  // 500 Hz to 50 kHz
  const std::string first = "r" + std::to_string(k), next = "r" + std::to_string(k + 1);
  const double share = s.draw.Between(0.2, 0.8);
  return {CatalogueEffect("eddy-impedance", s.target,
                          {{first, 0.1 * s.size * share}, {next, 0.1 * s.size * (1 - share)}})};
}

}  // namespace

std::vector<PracticeLaw> DiffusionLaws() {
  return {
      {"eddy-order", "diffusion of another order", "eddy-currents", "eddy-currents", OtherOrder},
      {"eddy-two-sheets", "diffusion into two sheets", "eddy-currents", "eddy-currents", TwoSheets},
      {"eddy-ring", "diffusion of another order", "eddy-currents", "eddy-currents", Ring}};
}

}  // namespace ambrig
