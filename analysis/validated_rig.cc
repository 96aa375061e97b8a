#include "analysis/validated_rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/load_capacity.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

/// k_i when the two coils beside an axis work as one horseshoe, against the two opposite (radial).
double HorseshoeGain(const OperatingPoint& point, std::size_t bearing, Eigen::Index side) {
  const LinearBearing& b = point.bearings[bearing];
  const StatorLanes& lanes = point.plant().bearings[bearing].lanes;
  Eigen::VectorXd pattern(static_cast<Eigen::Index>(b.coils.size()));
  for (Eigen::Index k = 0; k < pattern.size(); ++k) {
    const int j = b.coils[static_cast<std::size_t>(k)];
    const double own = side == 0 ? lanes.direction_x[j] : lanes.direction_y[j];
    const double other = side == 0 ? lanes.direction_y[j] : lanes.direction_x[j];
    pattern(k) = std::abs(own) > std::abs(other) ? std::copysign(1.0, own) : 0;
  }
  return b.ForceOfCurrent().row(side) * pattern;
}

/// f = k [(i0 + i)²/(g - x)² - (i0 - i)²/(g + x)²]: k from k_i = 4 k i0/g².
double ForceConstantOf(const RigParameters& rig, const BearingParameters& b, double k_i) {
  const GapReluctance r = b.kind->stator(b).reluctance;
  const double gap = r.gap0 + r.offset / r.per_metre;
  return k_i * gap * gap / (4 * BiasCurrent(rig, b));
}

}  // namespace

std::vector<double> FiguresOfRig(const RigParameters& rig, const TomlTable& check,
                                 const std::string& quantity) {
  const std::string axis = check.String("axis");
  const OperatingPoint point = FindOperatingPoint(rig);
  for (const AxisCapacity& c : FindCapacity(point)) {
    if (c.axis != axis) continue;
    if (quantity == "k_i") return {c.k_i};
    if (quantity == "k_s") return {c.k_s};
    if (quantity == "unstable pole") return {std::sqrt(c.k_s / rig.rotor.mass)};
    for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
      const auto names = rig.bearings[k].Axes();
      const auto side = std::find(names.begin(), names.end(), axis) - names.begin();
      if (side == static_cast<std::ptrdiff_t>(names.size())) continue;
      const bool radial = rig.bearings[k].kind->two_axes;
      const double k_i = radial ? HorseshoeGain(point, k, side) : c.k_i;
      if (quantity == "horseshoe k_i" && radial) return {k_i};
      if (quantity == "force constant") return {ForceConstantOf(rig, rig.bearings[k], k_i)};
    }
    check.Fail("quantity", fmt::format("\"{}\" is no quantity of this rig", quantity));
  }
  check.Fail("axis", fmt::format("\"{}\", allowed: {}", axis, fmt::join(point.Axes(), ", ")));
}

}  // namespace ambrig
