/// The rig file with what an adoption found. Only what was found changes: comments, order and every
/// other digit of the user's file stay.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/errors.h"
#include "core/base/toml_edit.h"
#include "discovery/refine/adopt.h"

namespace ambrig {

namespace {

/// A fitted number: what was found is not known to more than nine digits.
TomlLiteral Rounded(double v) {
  return {std::isfinite(v) ? TomlNumber(std::stod(fmt::format("{:.9g}", v))) : TomlNumber(v)};
}

/// As the reader allows it: of a positive number at most itself, else the width of its range.
double WrittenSd(const EffectInstance& e, std::size_t k) {
  const EffectParameter& p = e.table[k];
  const double most = p.lo > 0 ? std::abs(e.values[k]) : p.hi - p.lo;
  return std::min(e.sd[k], most);
}

/// One parameter of an effect: its value, its sd, and of a formula's what the file says of it.
std::string ParameterText(const EffectInstance& e, std::size_t k) {
  const bool formula = e.IsFormula(), fitted = k < e.sd.size() && e.sd[k] > 0;
  if (!formula && !fitted) return Rounded(e.values[k]).text;
  std::string text = "{ value = " + Rounded(e.values[k]).text;
  if (fitted) text += ", sd = " + Rounded(WrittenSd(e, k)).text;
  if (formula) {
    const EffectParameter& p = e.table[k];
    if (p.has_null) text += ", null = " + Rounded(p.null_value).text;
    text += fmt::format(", min = {}, max = {}, unit = \"{}\"", Rounded(p.lo).text,
                        Rounded(p.hi).text, p.unit);
  }
  return text + " }";
}

std::string ParametersText(const EffectInstance& e) {
  std::string text = "{ ";
  for (std::size_t k = 0; k < e.table.size(); ++k)
    text += fmt::format("{}{} = {}", k == 0 ? "" : ", ", e.table[k].name, ParameterText(e, k));
  return text + " }";
}

/// An effect that the file does not have yet.
std::string EffectText(const EffectInstance& e) {
  std::string text = fmt::format("\n[[effect]]\nname = \"{}\"\n", e.name);
  if (!e.label.empty()) text += fmt::format("label = \"{}\"\n", e.label);
  text += fmt::format("target = \"{}\"\nparameters = {}\n", e.target, ParametersText(e));
  // force, reading: inline tables; voltage, torque: texts
  std::map<std::string, std::string> kinds;
  for (const auto& [where, formula] : e.formulas) {
    const auto dot = where.find('.');
    if (dot == std::string::npos) {
      text += fmt::format("{} = \"{}\"\n", where, formula);
    } else {
      std::string& inside = kinds[where.substr(0, dot)];
      inside +=
          fmt::format("{}{} = \"{}\"", inside.empty() ? "" : ", ", where.substr(dot + 1), formula);
    }
  }
  for (const auto& [kind, inside] : kinds) text += fmt::format("{} = {{ {} }}\n", kind, inside);
  return text;
}

/// Whether an effect of the file, at this place of its list, is `e`.
bool IsEffect(const TomlTable& t, const EffectInstance& e) {
  return t.String("name", "") == e.name && t.String("target", e.target) == e.target &&
         t.String("label", "") == e.label;
}

/// The number at `path` becomes `value`; digits that say the same stay.
std::string WithNumber(const std::string& text, const std::string& file, const std::string& path,
                       double value) {
  const TomlLiteral rounded = Rounded(value);
  if (HasTomlPath(text, file, path)) {
    const double old = TomlNumberAt(text, file, path);
    if (old == value || TomlNumber(old) == rounded.text) return text;
  }
  return EditedToml(text, file, {{path, rounded}});
}

/// New values in the parameters of effect `k` of the file; what was not fitted stays as written.
std::string WithParameters(std::string text, const std::string& file, std::size_t k,
                           const EffectInstance& e) {
  const std::string all = fmt::format("effect[{}].parameters", k);
  if (!HasTomlPath(text, file, all))
    return EditedToml(text, file, {{all, TomlLiteral{ParametersText(e)}}});
  for (std::size_t row = 0; row < e.table.size(); ++row) {
    const std::string path = all + "." + e.table[row].name;
    const bool fitted = row < e.sd.size() && e.sd[row] > 0;
    const bool table = HasTomlPath(text, file, path + ".value");
    if (fitted && !table) {
      text = EditedToml(text, file, {{path, TomlLiteral{ParameterText(e, row)}}});
      continue;
    }
    text = WithNumber(text, file, table ? path + ".value" : path, e.values[row]);
    if (fitted) text = WithNumber(text, file, path + ".sd", WrittenSd(e, row));
  }
  return text;
}

/// Effects that are in the file get their new parameters there, those that are no more are taken
/// out, new ones are put at the end.
std::string WithEffects(std::string text, const std::string& file,
                        const std::vector<EffectInstance>& effects) {
  const auto tables = TomlTable::FromText(text, file).Tables("effect");
  std::vector<const EffectInstance*> known(tables.size());
  std::string added;
  for (const EffectInstance& e : effects) {
    std::size_t k = 0;
    while (k < tables.size() && (known[k] || !IsEffect(tables[k], e))) ++k;
    if (k < tables.size())
      known[k] = &e;
    else
      added += EffectText(e);
  }
  for (std::size_t k = tables.size(); k-- > 0;)
    text = known[k] ? WithParameters(text, file, k, *known[k])
                    : WithoutTomlTable(text, file, fmt::format("effect[{}]", k));
  return text + added;
}

/// The errors that the coils of a bearing are known to have, none of them to more than four digits;
/// lists that the file has stay as written.
std::string WithCoilErrors(std::string text, const std::string& file, const BearingParameters& b) {
  const std::string path = fmt::format("bearings.{}.coil_errors", b.name);
  const auto put = [&](const std::string& key, const std::vector<double>& errors) {
    if (errors.empty()) return;
    if (!HasTomlPath(text, file, path)) text = EditedToml(text, file, {{path, TomlLiteral{"{}"}}});
    const TomlTable bearings = *TomlTable::FromText(text, file).Table("bearings");
    const TomlTable known = *bearings.Table(b.name)->Table("coil_errors");
    if (known.Has(key) && known.Numbers(key) == errors) return;
    const std::string list = fmt::format("[{:.4g}]", fmt::join(errors, ", "));
    text = EditedToml(text, file, {{path + "." + key, TomlLiteral{list}}});
  };
  put("current_gain", b.coil_errors.current_gain);
  put("edge", b.coil_errors.edge);
  return text;
}

/// Paths of parameters count tables from 1, those of edits from 0.
std::string EditPath(std::string path) {
  const std::size_t open = path.find('['), close = path.find(']');
  if (open == std::string::npos || close == std::string::npos) return path;
  const int index = std::stoi(path.substr(open + 1, close - open - 1));
  return path.replace(open + 1, close - open - 1, std::to_string(index - 1));
}

}  // namespace

std::string AdoptedRigText(const std::string& text, const Hypothesis& h,
                           const std::vector<EffectInstance>& effects) {
  const std::string& file = h.rig.file;
  std::string out = text;
  for (const FreeParameter& p : h.free) {
    if (p.effect >= 0) continue;
    const std::string path = EditPath(p.path);
    if (HasTomlPath(out, file, path + ".sd")) {
      out = EditedToml(out, file, {{path + ".fitted", Rounded(p.value)}});
      continue;
    }
    if (p.path.starts_with("rotor."))
      throw InputError(
          fmt::format("{} has its sd in the shaft's own file, allowed with adopt: the shaft's "
                      "tables in the rig "
                      "file",
                      p.path));
    // A `like` bearing inherits value and sd; its own calibration needs its own line.
    const std::string holder = path.substr(0, path.rfind('.'));
    if (HasTomlPath(out, file, holder))
      out = EditedToml(out, file,
                       {{path, TomlLiteral{fmt::format("{{ value = {}, sd = {}, fitted = {} }}",
                                                       Rounded(p.start).text, Rounded(p.sd).text,
                                                       Rounded(p.value).text)}}});
  }
  for (const BearingParameters& b : h.rig.bearings) out = WithCoilErrors(out, file, b);
  return WithEffects(out, file, effects);
}

}  // namespace ambrig
