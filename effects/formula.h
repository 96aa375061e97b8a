#pragma once
/// The effect `formula`: a law that the user writes in the rig file.
///
///   target           quantity                       meaning
///   plane            force = { x, y }               on the rotor at that plane, its opposite on
///   the
///                                                   stator [N]; for "z": force = "..." along z
///   plane            reading = { x, y }             what the sensors read instead of x, y [m]
///   axis             force = "..", reading = ".."   the same for one axis
///   coil, bearing    voltage = ".."                 in series with the coil (with each coil) [V]
///   rig              torque = ".."                  on a rotor of free speed [N m]
///
/// Known inside: x, y, vx, vy (shaft centre at the plane; a thrust bearing's x is z; rig: at the
/// centre of mass; in a reading: what the sensor would read), theta, omega, t, bus; except for
/// "rig" also i1..i8 of the bearing; for a coil i, its own current; the parameters;
/// FormulaFunctions(). Source: docs/effects.md.
#include <string>
#include <vector>

#include "effects/effect.h"

namespace ambrig {

inline constexpr int kFormulaCurrents = 8;  // i1..i8

enum class FormulaTarget { kRig, kPlane, kAxis, kCoil };

FormulaTarget FormulaTargetOf(const std::string& target);
/// Names known inside formulas for this target, before the effect's own parameters.
std::vector<std::string> FormulaNames(FormulaTarget target);

/// Reads parameters and formulas of a `formula` effect. @throws InputError naming the wrong
/// formula.
void ReadFormula(const TomlTable& table, EffectInstance& effect);

}  // namespace ambrig
