/// Free shapes of forces: force against displacement, drag against speed. Each is a `formula` of
/// ramps in the rig file: piecewise linear, continuous, with a slope per stretch.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "discovery/shape/shape.h"
#include "effects/catalogue.h"

namespace ambrig {

namespace {

constexpr int kStretches = 6;

/// "(k1*min(r,d) + k2*min(max(r-d,0),d) + ... + k6*max(r-5*d,0))"
std::string Ramps(const std::string& r, double d) {
  std::string text = fmt::format("(k1*min({},{:.9g})", r, d);
  for (int k = 1; k < kStretches; ++k) {
    const std::string beyond = fmt::format("max({}-{:.9g},0)", r, k * d);
    text += k + 1 < kStretches ? fmt::format(" + k{}*min({},{:.9g})", k + 1, beyond, d)
                               : fmt::format(" + k{}*{}", k + 1, beyond);
  }
  return text + ")";
}

double RampSum(const std::vector<double>& slopes, double d, double r) {
  double sum = 0;
  for (int k = 0; k < kStretches; ++k) {
    const double more = std::max(0.0, r - k * d);
    sum += slopes[static_cast<std::size_t>(k)] * (k + 1 < kStretches ? std::min(more, d) : more);
  }
  return sum;
}

EffectParameter Slope(int k, double size, bool negative, const std::string& unit) {
  EffectParameter p;
  p.name = fmt::format("k{}", k + 1);
  p.unit = unit;
  p.lo = negative ? -1e9 : 0;
  p.hi = negative ? 0 : 1e9;
  p.typical_lo = 0.5 * size;
  p.typical_hi = size;
  p.doc = fmt::format("slope of stretch {} of {}", k + 1, kStretches);
  return p;
}

/// The formula effect with equal stretches up to `most`, slopes given at their middles.
Shape RampShape(const EffectInstance& named, double most, const std::string& unit,
                const std::function<double(double)>& slope) {
  Shape s = FormulaShape(named, named.target);
  const double d = most / kStretches;
  double size = 0;
  for (int k = 0; k < kStretches; ++k) size = std::max(size, std::abs(slope((k + 0.5) * d)));
  for (int k = 0; k < kStretches; ++k) {
    const double at = slope((k + 0.5) * d);
    AddFormulaSize(s, Slope(k, std::max(size, 1e-12), at < 0, unit), at);
    s.knots.push_back((k + 0.5) * d);
  }
  s.step = Eigen::VectorXd::Constant(kStretches, std::max(0.3 * size, 1e-12));
  s.roughness = Differences(kStretches, 2);
  s.u = CurvePlaces(most);
  s.value = [d](const std::vector<double>& c, double u) { return RampSum(c, d, u); };
  return s;
}

Shape PullShape(const EffectInstance& named, double radius) {
  const double stiffness = named.Value("stiffness");
  const bool along = named.name == "side-pull";
  Shape s = RampShape(named, radius, "N/m", [&](double) { return stiffness; });
  // a motor pulls from its own centre; at the centre neither direction exists, the force is zero
  const std::string x = along ? fmt::format("(x - {:.9g})", named.Value("ex")) : "x",
                    y = along ? fmt::format("(y - {:.9g})", named.Value("ey")) : "y",
                    r = fmt::format("sqrt({0}*{0} + {1}*{1} + 1e-20)", x, y),
                    force = Ramps(r, radius / kStretches) + "/" + r;
  s.effect.formulas = {{"force.x", (along ? x : "-" + y) + "*" + force},
                       {"force.y", (along ? y : x) + "*" + force}};
  s.u_name = "displacement";
  s.u_unit = "m";
  s.value_name = along ? "force along the displacement" : "force across the displacement";
  s.value_unit = "N";
  return s;
}

}  // namespace

Shape MotionShape(const EffectInstance& named, const ShapeReach& reach) {
  if (named.name == "windage") {
    if (reach.speed <= 0)
      throw InputError(
          "windage: no record of this case turns, allowed: one "
          "that coasts down");
    const double drag = named.Value("drag");
    Shape s = RampShape(named, reach.speed, "N m s", [&](double w) { return 2 * drag * w; });
    s.effect.formulas = {
        {"torque", "-sign(omega)*" + Ramps("abs(omega)", reach.speed / kStretches)}};
    s.u_name = "speed";
    s.u_unit = "rad/s";
    s.value_name = "drag torque";
    s.value_unit = "N m";
    return s;
  }
  if (named.target == "z")
    throw InputError(named.name + " at z has no curve to refine, allowed: a radial plane");
  if (reach.radius <= 0)
    throw InputError(
        fmt::format("{} at {}: no record of this case moves this plane, allowed: a "
                    "case with levitated records",
                    named.name, named.target));
  return PullShape(named, reach.radius);
}

}  // namespace ambrig
