#include "rotor/shaft/ross_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/counted.h"
#include "core/base/json_file.h"
#include "core/base/toml.h"

namespace ambrig {
namespace {

// Below this a shaft element carries nothing: the sleeves of WriteRoss.
constexpr double kSleeveE = 1e3;

/// One table of the file, whatever its format. Booleans are 0 and 1.
struct Element {
  std::string kind, name, where;
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;
  std::map<std::string, double> material;
  bool two_axes = false;  // coefficients over speed and frequency of the whirl (version 3)

  [[noreturn]] void Fail(const std::string& text) const {
    throw InputError(fmt::format("{}: {}", where, text));
  }
  bool Has(const std::string& key) const { return numbers.count(key) && !numbers.at(key).empty(); }
  double Get(const std::string& key) const {
    if (!Has(key)) Fail(key + " is missing");
    return numbers.at(key)[0];
  }
  double Get(const std::string& key, double fallback) const {
    return Has(key) ? numbers.at(key)[0] : fallback;
  }
  int Node() const {
    const double n = Get("n");
    if (n < 0 || n > 1e6 || n != std::floor(n))
      Fail(fmt::format("n = {}, allowed: a node number", NumberText(n)));
    return static_cast<int>(n);
  }
};

Element Named(const std::string& key, const std::string& where) {
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
  const bool coefficient = key.size() == 3 && (key[0] == 'k' || key[0] == 'c');
  return coefficient || key == "speed" || key == "frequency" || key == "w" ||
         key == "modal_damping_ratio";
}

void ReadList(const TomlTable& t, const std::string& key, Element& e) {
  try {
    e.numbers[key] = t.Numbers(key);
  } catch (const InputError&) {
    t.Rows(key);  // else it is neither: its own message
    e.two_axes = true;
  }
}

std::vector<Element> FromToml(const std::string& file) {
  std::vector<Element> out;
  const TomlTable root = TomlTable::FromFile(file);
  for (const std::string& key : root.Keys()) {
    if (!root.IsTable(key)) continue;
    const TomlTable t = *root.Table(key);
    Element e = Named(key, t.Where());
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

std::vector<double> Numbers(const nlohmann::json& value) {
  if (value.is_number()) return {value.get<double>()};
  if (value.is_boolean()) return {value.get<bool>() ? 1.0 : 0.0};
  std::vector<double> out;
  if (value.is_array())
    for (const auto& v : value)
      if (v.is_number()) out.push_back(v.get<double>());
  return out;
}

std::vector<Element> FromJson(const std::string& file) {
  const nlohmann::json root = ReadJson(file);
  std::vector<Element> out;
  for (const auto& [key, table] : root.items()) {
    if (!table.is_object()) continue;
    Element e = Named(key, fmt::format("{}: {}", file, key));
    for (const auto& [k, v] : table.items()) {
      if (v.is_string()) e.texts[k] = v.get<std::string>();
      if (!Numbers(v).empty()) e.numbers[k] = Numbers(v);
      if (IsTabulated(k) && v.is_array() && !v.empty() && v[0].is_array()) e.two_axes = true;
      if (k == "material" && v.is_object())
        for (const auto& [m, number] : v.items())
          if (number.is_number()) e.material[m] = number.get<double>();
    }
    out.push_back(e);
  }
  return out;
}

bool IsJson(const std::string& file) {
  return file.size() > 5 && file.substr(file.size() - 5) == ".json";
}
bool IsShaft(const Element& e) { return e.kind == "ShaftElement" || e.kind == "ShaftElement6DoF"; }
bool IsDisk(const Element& e) { return e.kind == "DiskElement" || e.kind == "DiskElement6DoF"; }

Material ReadRossMaterial(const Element& e) {
  const auto get = [&](const char* key) {
    const auto it = e.material.find(key);
    if (it == e.material.end()) e.Fail(fmt::format("material.{} is missing", key));
    return it->second;
  };
  Material m{get("E"), get("rho"), 0};
  m.nu = e.material.count("G_s") ? m.E / (2 * get("G_s")) - 1 : get("Poisson");
  if (!(m.E > 0 && m.rho >= 0 && m.nu >= -1e-9 && m.nu <= 0.5 + 1e-9))
    e.Fail(fmt::format("material E = {}, rho = {}, Poisson = {}: not a material", NumberText(m.E),
                       NumberText(m.rho), NumberText(m.nu)));
  return m;
}

ShaftSection ReadRossShaft(const Element& e) {
  ShaftSection s;
  s.name = e.name;
  s.length = e.Get("L");
  s.od = e.Get("odl");
  s.id = e.Get("idl");
  s.od_right = e.Get("odr", s.od);
  s.id_right = e.Get("idr", s.id);
  s.material = ReadRossMaterial(e);
  s.stiff = s.material.E > kSleeveE;
  s.damping_mass = e.Get("alpha", 0);
  s.damping_stiffness = e.Get("beta", 0);
  s.axial_force = e.Get("axial_force", 0);
  return s;
}

Disk ReadRossDisk(const Element& e, double z) {
  const Disk d{z, e.Get("m"), e.Get("Id"), e.Get("Ip"), e.name};
  CheckRanges(d, kDiskFields,
              [&](std::string_view key) { return fmt::format("{}: {}", e.where, key); });
  if (d.inertia_polar > 2 * d.inertia_diametral * (1 + 1e-9))
    e.Fail(fmt::format("Ip = {} kg m2, allowed up to twice Id = {} kg m2",
                       NumberText(d.inertia_polar), NumberText(d.inertia_diametral)));
  return d;
}

/// Node planes from the shaft elements, whose n is their left node.
std::vector<double> NodePlanes(const std::vector<Element>& elements, const std::string& file) {
  std::map<int, double> length;
  for (const Element& e : elements) {
    if (!IsShaft(e)) continue;
    const auto [it, fresh] = length.emplace(e.Node(), e.Get("L"));
    if (!fresh && std::abs(it->second - e.Get("L")) > 1e-9 * it->second)
      e.Fail("L differs from another shaft element at the same n");
  }
  if (length.empty())
    throw InputError(
        fmt::format("{}: no shaft element, allowed: a file saved by ROSS's Rotor.save", file));
  std::vector<double> z{0};
  for (const auto& [n, L] : length) {
    if (n + 1 != static_cast<int>(z.size()))
      throw InputError(fmt::format("{}: no shaft element with n = {}", file, z.size() - 1));
    z.push_back(z.back() + L);
  }
  return z;
}

double PlaneOf(const Element& e, const std::vector<double>& z) {
  if (e.Node() >= static_cast<int>(z.size()))
    e.Fail(fmt::format("n = {}, allowed 0 to {} (nodes of the shaft)", e.Node(), z.size() - 1));
  return z[e.Node()];
}

void ReadRossTheory(const Element& e, bool first, BeamTheory& theory) {
  BeamTheory t = theory;
  t.shear = e.Get("shear_effects", 1) != 0;
  t.rotary_inertia = e.Get("rotary_inertia", 1) != 0;
  t.gyroscopic = e.Get("gyroscopic", 1) != 0;
  const bool hutchinson =
      e.texts.count("shear_method_calc") && e.texts.at("shear_method_calc") == "hutchinson";
  t.coefficient = hutchinson ? ShearCoefficient::kHutchinson : ShearCoefficient::kCowper;
  const bool same = t.shear == theory.shear && t.rotary_inertia == theory.rotary_inertia &&
                    t.gyroscopic == theory.gyroscopic && t.coefficient == theory.coefficient;
  if (!first && !same)
    e.Fail(
        "shear_effects, rotary_inertia, gyroscopic or shear_method_calc differ from another "
        "element, "
        "allowed: one choice for the whole shaft");
  theory = t;
}

double At(const Element& e, const std::string& key, double fallback, double speed) {
  if (!e.Has(key)) return fallback;
  const std::vector<double>& y = e.numbers.at(key);
  if (y.size() == 1) return y[0];
  const char* axis = e.Has("speed") ? "speed" : e.Has("frequency") ? "frequency" : "w";
  const auto it = e.numbers.find(axis);
  if (it == e.numbers.end() || it->second.size() != y.size())
    e.Fail(fmt::format("{} has {}, allowed: one, or as many as {}", key, Counted(y.size(), "value"),
                       axis));
  const std::vector<double>& x = it->second;
  const std::size_t i = std::clamp<std::size_t>(
      std::upper_bound(x.begin(), x.end(), speed) - x.begin(), 1, x.size() - 1);
  const double t = std::clamp((speed - x[i - 1]) / (x[i] - x[i - 1]), 0.0, 1.0);
  return y[i - 1] + t * (y[i] - y[i - 1]);
}

SpringSupport ReadRossSupport(const Element& e, double z, double speed) {
  if (e.Has("n_link"))
    e.Fail("n_link (a bearing on a housing) is not modelled, allowed: bearings to ground");
  SpringSupport s;
  s.z = z;
  s.name = e.name;
  s.kxx = At(e, "kxx", 0, speed), s.kyy = At(e, "kyy", s.kxx, speed);
  s.kxy = At(e, "kxy", 0, speed), s.kyx = At(e, "kyx", 0, speed);
  s.cxx = At(e, "cxx", 0, speed), s.cyy = At(e, "cyy", s.cxx, speed);
  s.cxy = At(e, "cxy", 0, speed), s.cyx = At(e, "cyx", 0, speed);
  return s;
}

}  // namespace

RossRotor ReadRoss(const std::string& file, double speed) {
  const std::vector<Element> elements = IsJson(file) ? FromJson(file) : FromToml(file);
  const std::vector<double> z = NodePlanes(elements, file);
  RossRotor out;
  BeamDefinition& d = out.definition;
  d.elements_per_section = 1;
  bool first = true;
  for (const Element& e : elements) {
    if (IsShaft(e)) {
      d.sections.push_back(ReadRossShaft(e));
      d.sections.back().z0 = PlaneOf(e, z);
      ReadRossTheory(e, first, d.theory);
      first = false;
    } else if (IsDisk(e)) {
      d.disks.push_back(ReadRossDisk(e, PlaneOf(e, z)));
    } else if (e.kind.find("MagneticBearing") == 0) {
      out.magnetic_bearings.push_back({e.name, PlaneOf(e, z)});
      d.stations.push_back(PlaneOf(e, z));
    } else if (e.two_axes) {
      out.ignored.push_back(e.kind + "_" + e.name +
                            " (coefficients over speed and whirl frequency)");
    } else if (e.Has("kxx")) {
      d.supports.push_back(ReadRossSupport(e, PlaneOf(e, z), speed));
    } else if (e.kind == "parameters") {
      for (const char* damping : {"alpha", "beta", "modal_damping_ratio", "default_damping_ratio"})
        if (e.Get(damping, 0) != 0) out.ignored.push_back(std::string("parameters.") + damping);
    } else {
      out.ignored.push_back(e.name.empty() ? e.kind : e.kind + "_" + e.name);
    }
  }
  // Tables come sorted by name; along the shaft is how people read them.
  const auto along = [](const auto& a, const auto& b) { return a.z < b.z; };
  std::stable_sort(d.sections.begin(), d.sections.end(),
                   [](const auto& a, const auto& b) { return a.z0 < b.z0; });
  std::stable_sort(d.disks.begin(), d.disks.end(), along);
  std::stable_sort(d.supports.begin(), d.supports.end(), along);
  return out;
}

}  // namespace ambrig
