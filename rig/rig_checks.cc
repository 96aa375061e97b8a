#include "rig/rig_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/toml_checked.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/true_rig.h"

namespace ambrig {

namespace {

/// "rig.toml:31: bearings.A.gap", the line of the innermost table that the file has.
std::string WhereOf(const TomlTable& root, const std::string& path) {
  const auto [at, rest] = InnermostOf(root, path);
  return rest.find('.') == std::string::npos && at.Has(rest) ? at.Where(rest)
                                                             : at.Where() + ": " + path;
}

void CheckBias(const TomlTable& t, const RigParameters& rig, double bias) {
  if (bias <= rig.amplifier.i_max) return;
  t.Fail("bias_current", fmt::format("= {} A, allowed: at most the amplifier's i_max = {} A", bias,
                                     rig.amplifier.i_max));
}

/// A largest force that cannot move the rotor noticeably is a slip of the unit.
void CheckForce(const TomlTable& t, const RigParameters& rig, double f_max) {
  constexpr double kLeastAcceleration = 1e-5;  // [m/s2]
  const double* mass = ParameterAt(rig, "rotor.mass");
  if (!mass || f_max >= kLeastAcceleration * *mass) return;
  t.Fail("f_max", fmt::format("= {} N, allowed: at least {:.2g} N, which moves the rotor of {} kg "
                              "with {} m/s2",
                              f_max, kLeastAcceleration * *mass, *mass, kLeastAcceleration));
}

void CheckWinding(const TomlTable& t, const std::string& winding) {
  if (winding.find('N') != std::string::npos && winding.find('S') != std::string::npos) return;
  t.Fail("winding", fmt::format("= \"{}\", allowed: both letters N and S (with all poles alike "
                                "the flux has no way back)",
                                winding));
}

void CheckSensor(const TomlTable& t, const BearingParameters& b, const RigParameters& rig) {
  const auto [lo, hi] = ShaftExtent(rig);
  if (b.sensor.z >= lo && b.sensor.z <= hi) return;
  t.Fail("sensor", fmt::format("has z = {} m, allowed: on the shaft, {:g} to {:g} m",
                               b.sensor.z + rig.z_origin, lo + rig.z_origin, hi + rig.z_origin));
}

/// A cone pulls along the shaft too, which a rig's planes do not take: only where z is fixed.
void CheckCone(const TomlTable& t, const BearingParameters& b, const RigParameters& rig) {
  const auto network = b.kind->stator(b).network;
  bool cone = false;
  for (int p = 0; network && p < network->poles(); ++p)
    cone = cone || network->pole(p).direction[2] != 0;
  for (const BearingParameters& other : rig.bearings)
    if (cone && other.kind->axial)
      t.Fail("", fmt::format("has conical poles, which pull along the shaft too, allowed: a rig "
                             "without axial bearing {} (z is fixed then)",
                             other.name));
}

void CheckEffects(const TomlTable& root, const RigParameters& rig) {
  const std::vector<TomlTable> tables = root.Tables("effect");
  std::map<std::pair<std::string, std::string>, std::string> seen;
  for (std::size_t k = 0; k < rig.effects.size(); ++k) {
    const EffectInstance& e = rig.effects[k];
    if (e.name == "formula") continue;  // laws of the user's own may add up
    const auto [it, fresh] = seen.emplace(std::pair(e.name, e.target), e.where);
    if (!fresh)
      tables[k].Fail("name", fmt::format("= \"{}\" on {} stands twice (first {}), allowed: once",
                                         e.name, e.target, it->second));
  }
}

/// Spreads of the rig's own numbers; a shaft's are checked with its tables.
void CheckSpreads(const TomlTable& root, const RigParameters& rig) {
  for (const Tolerance& k : rig.tolerances) {
    double lo = 0, hi = 0;
    std::string unit;
    const double* value = ParameterAt(rig, k.path);
    if (value == nullptr || !ParameterRange(rig, k.path, &lo, &hi, &unit)) continue;
    CheckSpread(WhereOf(root, k.path), k.sd, *value, lo, hi, unit);
  }
}

/// Fitted values, each in its range, that contradict each other: of what the reader asks
/// of the drawing's.
void CheckFittedTogether(const TomlTable& root, const RigParameters& rig) {
  RigParameters plant = rig;
  for (const Tolerance& k : rig.tolerances)
    if (!std::isnan(k.true_value) &&
        (k.path.starts_with("bearings.") || k.path.starts_with("rotor.inertia_")))
      SetParameter(plant, k.path, k.true_value);
  const RotorParameters& r = plant.rotor;
  if (rig.rotor_kind == "rigid" && r.inertia_polar > 2 * r.inertia_transverse)
    throw InputError(fmt::format(
        "{} = {} kg m2 with the fitted values, allowed: at most twice inertia_transverse = {} (no "
        "body has more)",
        WhereOf(root, "rotor.inertia_polar"), r.inertia_polar, r.inertia_transverse));
  for (const BearingParameters& b : plant.bearings)
    if (const double gap = GapOf(b); b.auxiliary && b.auxiliary->clearance >= gap)
      throw InputError(fmt::format(
          "{} = {} m with the fitted values, allowed: larger than the auxiliary clearance of {} m",
          WhereOf(root, "bearings." + b.name + ".gap"), gap, b.auxiliary->clearance));
}

}  // namespace

std::pair<double, double> ShaftExtent(const RigParameters& rig) {
  double lo = kInfinity, hi = -kInfinity;
  if (rig.beam) {
    for (const ShaftSection& s : rig.beam->definition.sections) {
      if (!s.stiff) continue;
      lo = std::min(lo, s.z0);
      hi = std::max(hi, s.z0 + s.length);
    }
    return {lo - rig.z_origin, hi - rig.z_origin};
  }
  for (const BearingParameters& b : rig.bearings) {
    if (!b.kind->two_axes) continue;
    lo = std::min(lo, b.z);
    hi = std::max(hi, b.z);
  }
  if (lo > hi) return {-kInfinity, kInfinity};  // a point has no axis
  return {std::min(lo - (hi - lo), 0.0), std::max(hi + (hi - lo), 0.0)};
}

void CheckRig(const TomlTable& root, const RigParameters& rig) {
  CheckSpreads(root, rig);
  if (HasCalibration(rig)) CheckFittedTogether(root, rig);
  if (const auto controller = root.Table("controller")) {
    CheckBias(*controller, rig, rig.controller.bias_current);
    CheckForce(*controller, rig, rig.controller.pid.f_max);
  }
  const TomlTable bearings = *root.Table("bearings");
  for (const BearingParameters& b : rig.bearings) {
    const TomlTable t = *bearings.Table(b.name);
    if (b.kind->eight_poles) CheckWinding(t, b.radial.winding);
    if (b.kind->two_axes) CheckSensor(t, b, rig);
    if (b.kind->two_axes) CheckCone(t, b, rig);
    if (b.kind->check)
      b.kind->check(t, b, rig.controller.bias_current, rig.amplifier.quadrants < 3);
    const double own = b.kind->own_bias(b);
    if (!std::isnan(own)) CheckBias(t, rig, own);
  }
  CheckEffects(root, rig);
}

}  // namespace ambrig
