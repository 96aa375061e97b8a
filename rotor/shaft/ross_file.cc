#include "rotor/shaft/ross_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "rotor/shaft/ross_elements.h"
#include "rotor/shaft/ross_nodes.h"
#include "rotor/shaft/ross_supports.h"

namespace ambrig {
namespace {

// Below this a shaft element carries nothing: the sleeves of WriteRoss.
constexpr double kSleeveE = 2e3;

using Element = RossElement;

Material ReadRossMaterial(const Element& e, std::vector<std::string>& lost) {
  const auto get = [&](const char* key) {
    const auto it = e.material.find(key);
    if (it == e.material.end()) e.Fail(fmt::format("material.{} is missing", key));
    return it->second;
  };
  Material m{get("E"), get("rho"), 0};
  m.nu = e.material.count("G_s") ? m.E / (2 * get("G_s")) - 1 : get("Poisson");
  const double nu = std::clamp(m.nu, -0.99, 0.5);
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
  s.torque = e.Get("torque", 0);
  return s;
}

Disk RossHub(const Element& e, const RossNodes& nodes, bool right) {
  const auto of = [&](const char* left_key, const char* right_key) {
    return e.Get(right ? right_key : left_key, 0);
  };
  const int node = e.Node() + (right ? 1 : 0);
  Disk hub;
  hub.z = nodes.At(e, node);
  hub.shaft = nodes.ShaftOf(node);
  hub.name = e.name + (right ? "_right" : "_left");
  hub.mass = of("m_l", "m_r");
  hub.inertia_polar = of("Ip_l", "Ip_r");
  hub.inertia_diametral = of("Id_l", "Id_r");
  if (hub.inertia_diametral == 0) hub.inertia_diametral = hub.inertia_polar / 2;  // as ROSS
  return hub;
}

/// Where no shaft follows: the left half, what lies behind it is named.
void ReadLastRossCoupling(const Element& e, const RossNodes& nodes, BeamDefinition& d,
                          std::vector<std::string>& lost) {
  const bool held = nodes.on_shaft(e.Node());
  if (held) d.disks.push_back(RossHub(e, nodes, false));
  const double mass = e.Get("m_r", 0) + (held ? 0 : e.Get("m_l", 0));
  lost.push_back(
      fmt::format("{}: {}, {} kg, kt_x = {} N/m", e.Label(),
                  held ? "its right half, which no shaft follows" : "no shaft at either side",
                  NumberText(mass), NumberText(e.Get("kt_x", 0))));
}

/// A coupling is a support of the left shaft on the right one and a disk at each of its ends.
void ReadRossCoupling(const Element& e, const RossNodes& nodes, BeamDefinition& d,
                      std::vector<std::string>& lost) {
  if (!nodes.on_shaft(e.Node() + 1)) return ReadLastRossCoupling(e, nodes, d, lost);
  SpringSupport s;
  s.name = e.name;
  s.z = nodes.At(e);
  s.to_z = nodes.At(e, e.Node() + 1);
  s.shaft = nodes.ShaftOf(e.Node());
  s.to = nodes.ShaftOf(e.Node() + 1);
  constexpr std::pair<const char*, double SupportCoefficients::*> kCoupled[] = {
      {"kt_x", &SupportCoefficients::kxx}, {"kt_y", &SupportCoefficients::kyy},
      {"kt_z", &SupportCoefficients::kzz}, {"kr_x", &SupportCoefficients::krx},
      {"kr_y", &SupportCoefficients::kry}, {"kr_z", &SupportCoefficients::krz},
      {"ct_x", &SupportCoefficients::cxx}, {"ct_y", &SupportCoefficients::cyy},
      {"ct_z", &SupportCoefficients::czz}, {"cr_x", &SupportCoefficients::crx},
      {"cr_y", &SupportCoefficients::cry}, {"cr_z", &SupportCoefficients::crz}};
  for (const auto& [key, at] : kCoupled) s.*at = e.Get(key, 0);
  d.supports.push_back(s);
  for (const bool right : {false, true}) {
    const Disk hub = RossHub(e, nodes, right);
    if (hub.mass != 0 || hub.inertia_polar != 0) d.disks.push_back(hub);
  }
}

Disk ReadRossDisk(const Element& e, const RossNodes& nodes) {
  const Disk d{nodes.At(e), e.Get("m"), e.Get("Id"), e.Get("Ip"), e.name, nodes.ShaftOf(e.Node())};
  CheckRanges(d, kDiskFields,
              [&](std::string_view key) { return fmt::format("{}: {}", e.where, key); });
  if (d.inertia_polar > 2 * d.inertia_diametral * (1 + 1e-9))
    e.Fail(fmt::format("Ip = {} kg m2, allowed up to twice Id = {} kg m2",
                       NumberText(d.inertia_polar), NumberText(d.inertia_diametral)));
  return d;
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

/// What the file holds beside shaft, disks and supports: carried as a plane, or named
/// with its size.
void NameTheRest(const Element& e, const RossNodes& nodes, RossRotor& out) {
  std::vector<std::string>& lost = out.ignored;
  if (IsRossMagneticBearing(e)) {
    RossMagnet m = ReadRossMagnet(e, lost);
    m.z = nodes.At(e);
    m.shaft = nodes.ShaftOf(e.Node());
    out.magnetic_bearings.push_back(std::move(m));
  } else if (e.two_axes) {
    lost.push_back(e.kind + "_" + e.name + " (coefficients over speed and whirl frequency)");
  } else if (e.kind == "parameters") {
    for (const char* damping : {"alpha", "beta", "modal_damping_ratio", "default_damping_ratio"})
      if (e.Get(damping, 0) != 0)
        lost.push_back(fmt::format("parameters.{} = {:g}", damping, e.Get(damping)));
  } else if (e.kind.find("PointMass") != 0 && !e.Has("kxx") && e.kind != "") {
    std::string size;
    for (const char* key : {"m", "m_l", "m_r", "kt_x", "kr_x", "kr_z", "Ip"})
      if (e.Has(key)) size += fmt::format(", {} = {:g}", key, e.Get(key));
    lost.push_back(e.Label() + size);
  }
}

}  // namespace

RossRotor ReadRoss(const std::string& file) {
  const std::vector<Element> elements = ReadRossElements(file);
  const RossNodes nodes(elements, file);
  RossRotor out;
  BeamDefinition& d = out.definition;
  d.elements_per_section = 1;
  d.shafts = nodes.shafts();
  bool first = true;
  std::map<int, int> layers;
  for (const Element& e : elements) {
    if (IsRossShaft(e)) {
      d.sections.push_back(ReadRossShaft(e, out.ignored));
      d.sections.back().z0 = nodes.At(e);
      d.sections.back().shaft = nodes.ShaftOf(e.Node());
      ReadRossTheory(e, first, d.theory);
      first = false;
      if (++layers[e.Node()] > 1) d.theory.separate_layers = true;
    } else if (IsRossDisk(e) && e.Has("n_teeth") && !e.Has("m")) {  // GearElementTVMS
      out.ignored.push_back(fmt::format("{}: its mass and mesh, of which ROSS saves the {} teeth",
                                        e.Label(), NumberText(e.Get("n_teeth"))));
    } else if (IsRossDisk(e)) {
      d.disks.push_back(ReadRossDisk(e, nodes));
      if (e.kind.find("Gear") == 0)
        out.ignored.push_back(e.Label() + ": its mesh with another shaft, taken as a disk alone");
    } else if (IsRossCoupling(e)) {
      ReadRossCoupling(e, nodes, d, out.ignored);
    } else {
      NameTheRest(e, nodes, out);
    }
  }
  AddRossSupports(elements, nodes, d, out.ignored);
  if (!d.shafts.empty()) LayOutShafts(d);
  for (RossMagnet& b : out.magnetic_bearings) {
    b.z = NodePlace(d.shafts, b.shaft, b.z);
    d.stations.push_back(b.z);
  }
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
