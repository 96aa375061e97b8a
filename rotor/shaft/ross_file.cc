#include "rotor/shaft/ross_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/counted.h"
#include "rotor/shaft/ross_elements.h"
#include "rotor/shaft/ross_supports.h"

namespace ambrig {
namespace {

// Below this a shaft element carries nothing: the sleeves of WriteRoss, and pieces so soft that people
// use them for mass alone.
constexpr double kSleeveE = 1e6, kWrittenSleeveE = 1e3;

using Element = RossElement;

bool IsShaft(const Element& e) { return e.kind == "ShaftElement" || e.kind == "ShaftElement6DoF"; }
bool IsDisk(const Element& e) { return e.kind == "DiskElement" || e.kind == "DiskElement6DoF"; }

Material ReadRossMaterial(const Element& e, std::vector<std::string>& lost) {
  const auto get = [&](const char* key) {
    const auto it = e.material.find(key);
    if (it == e.material.end()) e.Fail(fmt::format("material.{} is missing", key));
    return it->second;
  };
  Material m{get("E"), get("rho"), 0};
  m.nu = e.material.count("G_s") ? m.E / (2 * get("G_s")) - 1 : get("Poisson");
  const double nu = std::clamp(m.nu, 0.0, 0.5);
  if (std::abs(nu - m.nu) > 1e-9 && m.E >= kSleeveE)
    lost.push_back(fmt::format("Poisson's ratio {} of {}, taken as {}", NumberText(m.nu), e.Label(),
                               NumberText(nu)));
  m.nu = nu;
  if (!(m.E > 0 && m.rho >= 0))
    e.Fail(fmt::format("material E = {}, rho = {}, Poisson = {}: not a material", NumberText(m.E),
                       NumberText(m.rho), NumberText(m.nu)));
  return m;
}

ShaftSection ReadRossShaft(const Element& e, std::vector<std::string>& lost) {
  ShaftSection s;
  s.name = e.name;
  s.length = e.Get("L");
  s.od = e.Get("odl");
  s.id = e.Get("idl");
  s.od_right = e.Get("odr", s.od);
  s.id_right = e.Get("idr", s.id);
  s.material = ReadRossMaterial(e, lost);
  s.stiff = s.material.E >= kSleeveE;
  s.damping_mass = e.Get("alpha", 0);
  s.damping_stiffness = e.Get("beta", 0);
  s.axial_force = e.Get("axial_force", 0);
  if (const double torque = e.Get("torque", 0); torque != 0)
    lost.push_back(fmt::format("torque {} N m at {}", NumberText(torque), e.Label()));
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
    if (n + 1 != static_cast<int>(z.size())) {
      for (const Element& e : elements)
        if (e.kind == "CouplingElement")
          e.Fail("a coupling between two shafts is not modelled, allowed: one shaft");
      throw InputError(fmt::format("{}: no shaft element with n = {}", file, z.size() - 1));
    }
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

}  // namespace

namespace {

/// Shaft elements so soft that they are taken as mass, one line for all of one E.
void NameSoftElements(const std::vector<Element>& elements, std::vector<std::string>& lost) {
  std::map<double, std::vector<int>> soft;
  for (const Element& e : elements)
    if (IsShaft(e) && e.material.count("E"))
      if (const double E = e.material.at("E"); E > kWrittenSleeveE && E < kSleeveE)
        soft[E].push_back(e.Node());
  for (auto& [E, at] : soft) {
    std::sort(at.begin(), at.end());
    lost.push_back(fmt::format("E = {} N/m2 of {} at nodes {}, taken as mass without stiffness",
                               NumberText(E), Counted(at.size(), "shaft element"),
                               fmt::join(at, " ")));
  }
}

/// What the file holds beside shaft, disks and supports: carried as a plane, or named with its size.
void NameTheRest(const Element& e, const std::vector<double>& z, RossRotor& out) {
  std::vector<std::string>& lost = out.ignored;
  if (IsRossMagneticBearing(e)) {
    out.magnetic_bearings.push_back({e.name, PlaneOf(e, z)});
    out.definition.stations.push_back(PlaneOf(e, z));
    std::string numbers;
    for (const char* key : {"g0", "i0", "ag", "nw", "alpha", "kp_pid", "kd_pid", "ki_pid"})
      if (e.Has(key)) numbers += fmt::format(", {} = {:g}", key, e.Get(key));
    lost.push_back(
        fmt::format("{}: a magnetic bearing, its plane kept as a station{}", e.Label(), numbers));
  } else if (e.two_axes) {
    lost.push_back(e.kind + "_" + e.name + " (coefficients over speed and whirl frequency)");
  } else if (e.kind == "parameters") {
    for (const char* damping : {"alpha", "beta", "modal_damping_ratio", "default_damping_ratio"})
      if (e.Get(damping, 0) != 0)
        lost.push_back(fmt::format("parameters.{} = {:g}", damping, e.Get(damping)));
  } else if (e.kind != "PointMass" && !e.Has("kxx") && e.kind != "") {
    std::string size;
    for (const char* key : {"m", "m_l", "m_r", "kt_x", "kr_x", "kr_z", "Ip"})
      if (e.Has(key)) size += fmt::format(", {} = {:g}", key, e.Get(key));
    lost.push_back(e.Label() + size);
  }
}

}  // namespace

RossRotor ReadRoss(const std::string& file) {
  const std::vector<Element> elements = ReadRossElements(file);
  const std::vector<double> z = NodePlanes(elements, file);
  RossRotor out;
  BeamDefinition& d = out.definition;
  d.elements_per_section = 1;
  bool first = true;
  for (const Element& e : elements) {
    if (IsShaft(e)) {
      d.sections.push_back(ReadRossShaft(e, out.ignored));
      d.sections.back().z0 = PlaneOf(e, z);
      ReadRossTheory(e, first, d.theory);
      first = false;
    } else if (IsDisk(e)) {
      d.disks.push_back(ReadRossDisk(e, PlaneOf(e, z)));
    } else {
      NameTheRest(e, z, out);
    }
  }
  NameSoftElements(elements, out.ignored);
  AddRossSupports(elements, z, d, out.ignored);
  // Tables come sorted by name; along the shaft is how people read them.
  const auto along = [](const auto& a, const auto& b) { return a.z < b.z; };
  std::stable_sort(d.sections.begin(), d.sections.end(),
                   [](const auto& a, const auto& b) { return a.z0 < b.z0; });
  std::stable_sort(d.disks.begin(), d.disks.end(), along);
  std::stable_sort(d.supports.begin(), d.supports.end(), [](const auto& a, const auto& b) {
    return a.on_shaft() && (!b.on_shaft() || a.z < b.z);
  });
  return out;
}

}  // namespace ambrig
