#include "discovery/adopt.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <sstream>

namespace ambrig {

namespace {

std::string TomlNumber(double v) {
  if (std::isinf(v)) return v > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{:.9g}", v);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string EffectText(const EffectInstance& e) {
  std::string text = fmt::format("\n[[effect]]\nname = \"{}\"\n", e.name);
  if (!e.label.empty()) text += fmt::format("label = \"{}\"\n", e.label);
  text += fmt::format("target = \"{}\"\nparameters = {{ ", e.target);
  for (std::size_t k = 0; k < e.table.size(); ++k) {
    const bool formula = e.name == "formula";
    text += fmt::format("{}{} = ", k == 0 ? "" : ", ", e.table[k].name);
    if (!formula && (k >= e.sd.size() || e.sd[k] <= 0)) {
      text += TomlNumber(e.values[k]);
      continue;
    }
    text += fmt::format("{{ value = {}", TomlNumber(e.values[k]));
    if (k < e.sd.size() && e.sd[k] > 0) text += fmt::format(", sd = {}", TomlNumber(e.sd[k]));
    if (formula) {
      if (e.table[k].has_null) text += fmt::format(", null = {}", TomlNumber(e.table[k].null_value));
      text += fmt::format(", min = {}, max = {}, unit = \"{}\"", TomlNumber(e.table[k].lo), TomlNumber(e.table[k].hi), e.table[k].unit);
    }
    text += " }";
  }
  text += " }\n";
  std::map<std::string, std::string> kinds;  // force, reading: inline tables; voltage, torque: texts
  for (const auto& [where, formula] : e.formulas) {
    const auto dot = where.find('.');
    if (dot == std::string::npos) {
      text += fmt::format("{} = \"{}\"\n", where, formula);
    } else {
      std::string& inside = kinds[where.substr(0, dot)];
      inside += fmt::format("{}{} = \"{}\"", inside.empty() ? "" : ", ", where.substr(dot + 1), formula);
    }
  }
  for (const auto& [kind, inside] : kinds) text += fmt::format("{} = {{ {} }}\n", kind, inside);
  return text;
}

}  // namespace

std::string AdoptedRigText(const std::string& text, const Hypothesis& h, const std::vector<EffectInstance>& effects) {
  std::map<std::string, const FreeParameter*> fitted;  // by path
  for (const FreeParameter& p : h.free)
    if (p.effect < 0) fitted[p.path] = &p;
  std::istringstream in(text);
  std::string out, section, line;
  std::vector<std::string> copies;  // fitted values of numbers that a bearing has from `like`
  std::map<std::string, bool> written;
  const auto flush_inherited = [&] {
    // A `like` bearing inherits value and sd; its own calibration needs its own line.
    if (section.rfind("bearings.", 0) != 0) return;
    for (const auto& [path, p] : fitted) {
      if (written[path] || path.rfind(section + ".", 0) != 0) continue;
      const std::string key = path.substr(section.size() + 1);
      if (key.find('.') != std::string::npos) continue;
      out += fmt::format("{} = {{ value = {}, sd = {}, fitted = {} }}\n", key, TomlNumber(p->start), TomlNumber(p->sd), TomlNumber(p->value));
      written[path] = true;
    }
  };
  while (std::getline(in, line)) {
    const std::string trimmed = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (trimmed.starts_with("[")) {
      flush_inherited();
      section = trimmed.substr(1, trimmed.find(']') - 1);
    }
    const auto equals = trimmed.find('=');
    std::string key = equals == std::string::npos ? "" : trimmed.substr(0, equals);
    while (!key.empty() && (key.back() == ' ' || key.back() == '\t')) key.pop_back();
    const auto it = fitted.find(section + "." + key);
    if (!key.empty() && it != fitted.end() && !written[it->first] && line.find('{') != std::string::npos && line.find('}') != std::string::npos) {
      const std::string comment = line.substr(line.find('}') + 1);
      out += fmt::format("{} = {{ value = {}, sd = {}, fitted = {} }}{}\n", key, TomlNumber(it->second->start), TomlNumber(it->second->sd),
                         TomlNumber(it->second->value), comment);
      written[it->first] = true;
      continue;
    }
    out += line + "\n";
  }
  flush_inherited();
  for (const EffectInstance& e : effects) out += EffectText(e);
  return out;
}

}  // namespace ambrig
