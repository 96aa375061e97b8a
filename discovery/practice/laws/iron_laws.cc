/// Magnetisation curves of other families than the catalogue's: H grows as a power of B, by
/// Brauer's exponential, by the inverse of Langevin's function (Fröhlich's hyperbola); permeability
/// that rises by Rayleigh's law or falls from an initial value. As tables of the iron's incremental
/// path l mu0 dH/dB over the pole's flux density (effects/bh_curve.cc).
///   power:   path(x) = p x^n                             x = B/knee, n = 4 ... 9
///   Brauer:  path(x) = p (1 + 2 c x²) exp(c (x² - 1))    c = 1.5 ... 4
///   Fröhlich: path(x) = p/(1 - s x)²                     s x below 0.97
///   Rayleigh: path(x) = p/(1 + a x)²                     a = 0.5 ... 4
///   falling: path(x) = p ((1 - w) + w exp(-x))           w = 0.3 ... 0.9
/// Sources: Brauer 1975, IEEE Trans. Magn. 11 (exponential curve); Rayleigh 1887 (law of weak
/// fields).
#include <algorithm>
#include <cmath>
#include <functional>

#include "discovery/practice/laws/practice_law.h"
#include "effects/law_tables.h"

namespace ambrig {

namespace {

constexpr double kReach = 1.5;     // [T] of the last node
constexpr double kLongest = 2e-3;  // [m] incremental path at which air begins

EffectInstance Curve(const std::string& target, const std::function<double(double)>& path) {
  std::vector<std::pair<std::string, double>> values{{"reach", kReach}};
  for (int k = 0; k < kBhNodes; ++k)
    values.emplace_back("path" + std::to_string(k),
                        std::min(kLongest, path(kReach * k / (kBhNodes - 1))));
  return CatalogueEffect("bh-curve", target, values);
}

std::vector<EffectInstance> Power(LawSetting s) {
  const double knee = s.draw.Log(0.35, 0.8), order = s.draw.Between(4, 9);
  return {Curve(s.target, [=](double B) { return s.size * 3e-5 * std::pow(B / knee, order); })};
}

std::vector<EffectInstance> Brauer(LawSetting s) {
  const double knee = s.draw.Log(0.4, 0.9), c = s.draw.Between(1.5, 4);
  return {Curve(s.target, [=](double B) {
    const double x2 = std::min(9.0, B * B / (knee * knee));
    return s.size * 1e-5 * (1 + 2 * c * x2) * std::exp(c * (x2 - 1));
  })};
}

std::vector<EffectInstance> Froelich(LawSetting s) {
  const double end = s.draw.Log(0.5, 1.1);
  return {Curve(s.target, [=](double B) {
    return s.size * 4e-6 / std::pow(1 - std::min(0.97, B / end), 2);
  })};
}

std::vector<EffectInstance> Rayleigh(LawSetting s) {
  const double a = s.draw.Log(0.5, 4);
  return {Curve(s.target, [=](double B) { return s.size * 3e-5 / std::pow(1 + a * B, 2); })};
}

std::vector<EffectInstance> Falling(LawSetting s) {
  const double share = s.draw.Between(0.3, 0.9), scale = s.draw.Log(0.1, 0.4);
  return {Curve(s.target, [=](double B) {
    return s.size * 3e-5 * ((1 - share) + share * std::exp(-B / scale));
  })};
}

}  // namespace

std::vector<PracticeLaw> IronLaws() {
  return {
      {"saturation-power", "saturation by powers", "saturation", "saturation", Power},
      {"saturation-brauer", "saturation by exponentials", "saturation", "saturation", Brauer},
      {"saturation-froelich", "saturation by exponentials", "saturation", "saturation", Froelich},
      {"reluctance-rayleigh", "permeability that rises", "iron-reluctance", "iron-reluctance",
       Rayleigh},
      {"reluctance-falling", "permeability that changes early", "iron-reluctance",
       "iron-reluctance", Falling}};
}

}  // namespace ambrig
