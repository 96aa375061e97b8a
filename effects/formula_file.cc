/// Reading and checking of formulas in a rig file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "core/base/toml_checked.h"
#include "effects/formula.h"
#include "effects/formula_parser.h"

namespace ambrig {

namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void CheckName(const TomlTable& parameters, const std::string& key,
               const std::vector<std::string>& known) {
  if (Contains(known, key))
    parameters.Fail(key, "is a reserved name of formulas, allowed: any other name");
  if (!IsFormulaName(key))
    parameters.Fail(key,
                    "is not a valid parameter name, allowed: letters, digits and _, and none of " +
                        FormulaFunctions());
}

/// { value, null, min, max, unit, sd }, or a plain number.
void ReadParameter(const TomlTable& parameters, const std::string& key, EffectInstance& effect) {
  EffectParameter row;
  row.name = key;
  row.unit = "-";
  row.doc = "of the user's formula";
  row.has_null = false;
  double value = 0, sd = 0;
  if (parameters.IsTable(key)) {
    const TomlTable p = *parameters.Table(key);
    value = p.Number("value");
    row.has_null = p.Has("null");
    row.null_value = p.Number("null", value);
    row.lo = p.Number("min", -kInfinity);
    row.hi = p.Number("max", kInfinity);
    row.unit = p.String("unit", "-");
    sd = Within(p, "sd", 0, {row.unit, 0, 1e12, "one-sigma spread"});
    p.RejectUnknownKeys();
    const auto check = [&](const char* what, double v) {
      if (!(row.lo <= v && v <= row.hi))
        ThrowOutOfRange(p.Where(what), what, v, row.unit, row.lo, row.hi, row.doc);
    };
    check("value", value);
    check("null", row.null_value);
  } else {
    value = row.null_value = parameters.Number(key);
  }
  // The usual size of a fit's step: what the user wrote, else the bounds, else 1.
  double size = std::abs(value);
  if (size == 0) size = std::isfinite(row.hi) ? 0.1 * std::abs(row.hi) : 0;
  if (size == 0) size = std::isfinite(row.lo) ? 0.1 * std::abs(row.lo) : 0;
  row.typical_hi = size > 0 ? size : 1;
  row.typical_lo = 0.1 * row.typical_hi;
  effect.table.push_back(row);
  effect.values.push_back(value);
  effect.sd.push_back(sd);
}

/// Largest value of a quantity that a rig can have [SI].
Range RangeOf(const std::string& quantity) {
  if (quantity == "voltage") return {"V", -1e5, 1e5, "in series with a coil"};
  if (quantity == "torque") return {"N m", -1e6, 1e6, "on the rotor"};
  if (quantity == "reading") return {"m", -1, 1, "what a sensor reads"};
  return {"N", -1e8, 1e8, "on the rotor"};
}

/// Where a formula is tried: off centre to both sides, and at the centre.
struct Trial {
  double sign;
  const char* at;
};
constexpr Trial kTrials[] = {{1, "at x = y = 1e-5 m"},
                             {-1, "at x = y = -1e-5 m"},
                             {0, "with the shaft at rest at x = y = 0"}};

/// Parses the formula and evaluates it where the rotor certainly comes to be.
void Check(const std::string& text, const std::string& where, const EffectInstance& effect,
           const std::string& quantity) {
  std::vector<std::string> names = FormulaNames(FormulaTargetOf(effect.target));
  const std::size_t known = names.size();
  for (const EffectParameter& p : effect.table) names.push_back(p.name);
  const FormulaExpression formula(text, names, where);
  const Range range = RangeOf(quantity.substr(0, quantity.find('.')));
  const std::string shown = text.size() > 60 ? text.substr(0, 57) + "..." : text;
  for (const Trial& trial : kTrials) {
    std::vector<double> values(names.size());
    for (std::size_t k = 0; k < known; ++k) {
      const char first = names[k][0];
      values[k] = 1 + 0.01 * static_cast<double>(k);  // currents, angle, time
      if (names[k] == "bus") values[k] = 30;
      if (names[k] == "omega") values[k] = 100;
      if (first == 'x' || first == 'y') values[k] = trial.sign * 1e-5;
      if (first == 'v') values[k] = trial.sign * 1e-3;
    }
    std::copy(effect.values.begin(), effect.values.end(),
              values.begin() + static_cast<std::ptrdiff_t>(known));
    const double v = formula(values.data());
    if (!(range.lo <= v && v <= range.hi))
      throw InputError(
          fmt::format("{} = \"{}\": gives {} {}, allowed {} to {} {}", where, shown,
                      std::isnan(v) ? "no number" : fmt::format("{} {}", v, range.unit), trial.at,
                      range.lo, range.hi, range.unit));
  }
}

void Add(const TomlTable& table, const std::string& table_key, const std::string& name,
         EffectInstance& effect) {
  const std::string text = table.String(table_key);
  Check(text, table.Where(table_key), effect, name);
  effect.formulas.emplace_back(name, text);
}

const char* Needs(const std::string& quantity) {
  if (quantity == "torque") return "\"rig\"";
  if (quantity == "voltage") return "a coil or a bearing";
  return "a plane or an axis";
}

bool Fits(const std::string& quantity, FormulaTarget target, const std::string& name) {
  if (quantity == "torque") return target == FormulaTarget::kRig;
  if (quantity == "voltage")
    return target == FormulaTarget::kCoil || (target == FormulaTarget::kPlane && name != "z");
  return target == FormulaTarget::kPlane || target == FormulaTarget::kAxis;
}

void ReadQuantity(const TomlTable& table, const std::string& quantity, EffectInstance& effect) {
  const FormulaTarget target = FormulaTargetOf(effect.target);
  if (!Fits(quantity, target, effect.target))
    table.Fail(quantity,
               fmt::format("needs {} as target, not \"{}\"", Needs(quantity), effect.target));
  const bool one_axis = target == FormulaTarget::kAxis || effect.target == "z";
  if (quantity == "torque" || quantity == "voltage") return Add(table, quantity, quantity, effect);
  if (table.IsString(quantity)) {
    if (!one_axis) table.Fail(quantity, "acts on a plane, allowed: { x = \"...\", y = \"...\" }");
    const bool y =
        effect.target.size() > 2 && effect.target.substr(effect.target.size() - 2) == ".y";
    return Add(table, quantity, quantity + (y ? ".y" : ".x"), effect);
  }
  const auto both = table.Table(quantity);
  if (one_axis) table.Fail(quantity, "acts on one axis, allowed: a formula in quotes");
  for (const char* side : {"x", "y"})
    if (both->Has(side)) Add(*both, side, quantity + "." + side, effect);
  both->RejectUnknownKeys();
  if (both->Keys().empty()) table.Fail(quantity, "is empty, allowed: { x = \"...\", y = \"...\" }");
}

}  // namespace

FormulaTarget FormulaTargetOf(const std::string& target) {
  if (target == "rig") return FormulaTarget::kRig;
  if (NamesCoil(target)) return FormulaTarget::kCoil;
  return target.find('.') != std::string::npos ? FormulaTarget::kAxis : FormulaTarget::kPlane;
}

std::vector<std::string> FormulaNames(FormulaTarget target) {
  std::vector<std::string> names = {"x", "y", "vx", "vy", "theta", "omega", "t", "bus"};
  if (target == FormulaTarget::kRig) return names;
  for (int j = 1; j <= kFormulaCurrents; ++j) names.push_back("i" + std::to_string(j));
  if (target == FormulaTarget::kCoil) names.push_back("i");
  return names;
}

void ReadFormula(const TomlTable& table, EffectInstance& effect) {
  effect.table.clear();
  effect.values.clear();
  effect.sd.clear();
  effect.formulas.clear();
  const std::vector<std::string> known = FormulaNames(FormulaTargetOf(effect.target));
  if (const auto parameters = table.Table("parameters")) {
    for (const std::string& key : parameters->Keys()) {
      CheckName(*parameters, key, known);
      ReadParameter(*parameters, key, effect);
    }
    parameters->RejectUnknownKeys();
  }
  for (const char* quantity : {"force", "reading", "voltage", "torque"})
    if (table.Has(quantity)) ReadQuantity(table, quantity, effect);
  if (effect.formulas.empty())
    table.Fail("", "has no formula, allowed: force, reading, voltage or torque");
}

}  // namespace ambrig
