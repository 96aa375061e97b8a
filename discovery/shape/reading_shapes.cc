/// Free shape of a position sensor's gain: its reading over the displacement along its axis, as a
/// `formula` of ramps in the rig file. Piecewise linear through the centre, with a slope per
/// stretch.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"
#include "discovery/shape/shape.h"

namespace ambrig {

namespace {

constexpr int kSideStretches = 5, kAllStretches = 2 * kSideStretches;

/// Stretches of length d from the outermost negative one to the outermost positive one.
struct Stretch {
  int from_centre = 0;  // 0: next to the centre
  bool positive = true;
  bool outermost() const { return from_centre + 1 == kSideStretches; }
};

Stretch StretchNumber(int k) {
  if (k < kSideStretches) return {kSideStretches - 1 - k, false};
  return {k - kSideStretches, true};
}

/// What the displacement u has of a stretch.
double PartIn(const Stretch& s, double d, double u) {
  const double beyond = std::max((s.positive ? u : -u) - s.from_centre * d, 0.0),
               part = s.outermost() ? beyond : std::min(beyond, d);
  return s.positive ? part : -part;
}

/// The same as text.
std::string PartText(const Stretch& s, double d, const std::string& u) {
  const char *beyond_of = s.positive ? "max" : "min", *part_of = s.positive ? "min" : "max";
  const std::string from =
      s.from_centre > 0 ? fmt::format("{}{:.9g}", s.positive ? "-" : "+", s.from_centre * d) : "";
  const std::string beyond = fmt::format("{}({}{},0)", beyond_of, u, from);
  return s.outermost() ? beyond
                       : fmt::format("{}({},{:.9g})", part_of, beyond, s.positive ? d : -d);
}

// Of the law's gain, either way: sensors of bearings bend by a few percent, and stretches that few
// samples visit stay near the others.
constexpr double kMostBend = 1.1;

EffectParameter GainOfStretch(int k, double gain) {
  EffectParameter p;
  p.name = fmt::format("g{}", k + 1);
  p.unit = "-";
  p.null_value = 1;
  p.lo = gain / kMostBend;
  p.hi = gain * kMostBend;
  p.typical_lo = 0.8;
  p.typical_hi = 1.2;
  p.doc = fmt::format("gain of stretch {} of {}", k + 1, kAllStretches);
  return p;
}

}  // namespace

Shape ReadingShape(const EffectInstance& named, const ShapeReach& reach) {
  const std::size_t dot = named.target.find('.');
  if (dot == std::string::npos)
    throw InputError(
        fmt::format("{} at {} has no curve to refine, allowed: an axis of a radial plane",
                    named.name, named.target));
  if (reach.radius <= 0)
    throw InputError(
        fmt::format("{} at {}: no record of this case moves this axis, allowed: a case with "
                    "levitated records",
                    named.name, named.target));
  const std::string u = named.target.substr(dot + 1);
  const double gain = named.Value("gain"), d = reach.radius / kSideStretches;
  Shape s = FormulaShape(named, named.target.substr(0, dot));
  std::string text;
  for (int k = 0; k < kAllStretches; ++k) {
    const Stretch stretch = StretchNumber(k);
    AddFormulaSize(s, GainOfStretch(k, gain), gain);
    s.knots.push_back((stretch.positive ? 1 : -1) * (stretch.from_centre + 0.5) * d);
    text += fmt::format("{}g{}*{}", k > 0 ? " + " : "", k + 1, PartText(stretch, d, u));
  }
  s.effect.formulas = {{"reading." + u, text}};
  s.step = Eigen::VectorXd::Constant(kAllStretches, std::max(0.3 * std::abs(gain - 1), 0.01));
  s.roughness = Differences(kAllStretches, 1);
  for (int k = 0; k < kCurvePoints; ++k)
    s.u.push_back(reach.radius * (2.0 * k / (kCurvePoints - 1) - 1));
  s.value = [d](const std::vector<double>& gains, double displacement) {
    double sum = -displacement;
    for (int k = 0; k < kAllStretches; ++k)
      sum += gains[static_cast<std::size_t>(k)] * PartIn(StretchNumber(k), d, displacement);
    return sum;
  };
  s.u_name = "displacement along " + u;
  s.u_unit = "m";
  s.value_name = "reading less displacement";
  s.value_unit = "m";
  return s;
}

}  // namespace ambrig
