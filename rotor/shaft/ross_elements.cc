#include "rotor/shaft/ross_elements.h"

#include <nlohmann/json.hpp>

#include "core/base/json_file.h"
#include "core/base/read_file.h"
#include "core/base/toml.h"

namespace ambrig {

namespace {

RossElement Named(const std::string& key, const std::string& where) {
  const std::size_t at = key.find('_');
  return {key.substr(0, at),
          at == std::string::npos ? "" : key.substr(at + 1),
          where,
          {},
          {},
          {},
          false};
}

/// Coefficients, their axes and damping ratios; other arrays (colours, names) may hold anything.
bool IsTabulated(const std::string& key) {
  const bool coefficient = key.size() == 3 && (key[0] == 'k' || key[0] == 'c' || key[0] == 'm');
  return coefficient || key == "speed" || key == "frequency" || key == "omega" || key == "w" ||
         key == "i0" || key == "k_amp" || key == "k_sense" || key == "modal_damping_ratio";
}

void ReadList(const TomlTable& t, const std::string& key, RossElement& e) {
  try {
    e.numbers[key] = t.Numbers(key);
  } catch (const InputError&) {
    t.Rows(key);  // else it is neither: its own message
    e.two_axes = true;
  }
}

std::vector<RossElement> RossFromToml(const std::string& file) {
  std::vector<RossElement> out;
  const TomlTable root = TomlTable::FromFile(file);
  for (const std::string& key : root.Keys()) {
    if (!root.IsTable(key)) continue;
    const TomlTable t = *root.Table(key);
    RossElement e = Named(key, t.Where());
    for (const std::string& k : t.Keys()) {
      if (t.IsNumber(k)) e.numbers[k] = {t.Number(k)};
      if (t.IsBool(k)) e.numbers[k] = {t.Bool(k, false) ? 1.0 : 0.0};
      if (t.IsString(k)) e.texts[k] = t.String(k);
      if (t.IsArray(k) && IsTabulated(k)) ReadList(t, k, e);
      if (k == "material" && t.IsTable(k))
        for (const std::string& m : t.Table(k)->Keys())
          if (t.Table(k)->IsNumber(m)) e.material[m] = t.Table(k)->Number(m);
    }
    out.push_back(e);
  }
  return out;
}

std::vector<double> JsonNumbers(const nlohmann::json& value) {
  if (value.is_number()) return {value.get<double>()};
  if (value.is_boolean()) return {value.get<bool>() ? 1.0 : 0.0};
  std::vector<double> out;
  if (value.is_array())
    for (const auto& v : value)
      if (v.is_number()) out.push_back(v.get<double>());
  return out;
}

std::vector<RossElement> RossFromJson(const std::string& file) {
  const nlohmann::json root = ReadJson(file);
  std::vector<RossElement> out;
  for (const auto& [key, table] : root.items()) {
    if (!table.is_object()) continue;
    RossElement e = Named(key, fmt::format("{}: {}", file, key));
    for (const auto& [k, v] : table.items()) {
      if (v.is_string()) e.texts[k] = v.get<std::string>();
      if (!JsonNumbers(v).empty()) e.numbers[k] = JsonNumbers(v);
      if (IsTabulated(k) && v.is_array() && !v.empty() && v[0].is_array()) e.two_axes = true;
      if (k == "material" && v.is_object())
        for (const auto& [m, number] : v.items())
          if (number.is_number()) e.material[m] = number.get<double>();
    }
    out.push_back(e);
  }
  return out;
}

}  // namespace

/// Versions before 2.1 write TOML whatever the file is called.
std::vector<RossElement> ReadRossElements(const std::string& file) {
  if (!file.ends_with(".json")) return RossFromToml(file);
  const std::string text = ReadFile(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool toml = first != std::string::npos && (text[first] == '[' || text[first] == '#') &&
                    text.find('=') != std::string::npos;
  return toml ? RossFromToml(file) : RossFromJson(file);
}

}  // namespace ambrig
