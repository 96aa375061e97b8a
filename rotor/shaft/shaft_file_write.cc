/// The [rotor] table of a beam as text that ReadBeam reads back to the same numbers.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/atomic_file.h"
#include "rotor/shaft/shaft_file.h"

namespace ambrig {
namespace {

/// TOML basic string.
std::string Quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "\"";
}

/// Shortest text that reads back, always a TOML float.
std::string Float(double v) {
  std::string text = fmt::format("{}", v);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

class ShaftLines {
 public:
  void Table(const char* header) { text += fmt::format("\n[[rotor.{}]]\n", header); }
  void Put(const char* key, double value) { text += fmt::format("{} = {}\n", key, Float(value)); }
  void PutUnless(const char* key, double value, double fallback) {
    if (value != fallback) Put(key, value);
  }
  void Put(const char* key, const std::string& value) {
    if (!value.empty()) text += fmt::format("{} = {}\n", key, Quoted(value));
  }
  std::string text;
};

using Shafts = std::vector<PlacedShaft>;

void AddSectionLines(const ShaftSection& s, const Shafts& shafts, ShaftLines& out) {
  out.Table(s.stiff ? "section" : "sleeve");
  out.Put("name", s.name);
  out.Put("shaft", s.shaft);
  out.Put("z0", PlaceOf(shafts, s.z0));
  out.Put("length", s.length);
  out.Put("od", s.od);
  out.PutUnless("id", s.id, 0);
  out.PutUnless("od_right", s.od_right, s.od);
  out.PutUnless("id_right", s.id_right, s.id);
  if (s.stiff) out.Put("E", s.material.E);
  out.Put("rho", s.material.rho);
  if (s.stiff) out.PutUnless("nu", s.material.nu, Material{}.nu);
  out.PutUnless("damping_mass", s.damping_mass, 0);
  out.PutUnless("damping_stiffness", s.damping_stiffness, 0);
  out.PutUnless("axial_force", s.axial_force, 0);
  out.PutUnless("torque", s.torque, 0);
}

void AddDisk(const Disk& d, const Shafts& shafts, ShaftLines& out) {
  out.Table("disk");
  // Names are targets in scenarios: no dots and blanks.
  std::string name = d.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.' || c == ' ' || c == '\t'; }, '_');
  out.Put("name", name);
  out.Put("shaft", d.shaft);
  out.Put("z", PlaceOf(shafts, d.z));
  out.Put("mass", d.mass);
  out.Put("inertia_diametral", d.inertia_diametral);
  out.Put("inertia_polar", d.inertia_polar);
}

void AddSupportLines(const SpringSupport& s, const Shafts& shafts, ShaftLines& out) {
  out.Table("support");
  out.Put("name", s.name);
  out.Put("carries", s.carries);
  out.Put("on", s.on);
  out.Put("shaft", s.shaft);
  if (s.on_shaft()) out.Put("z", PlaceOf(shafts, s.z));
  out.Put("to", s.to);
  if (s.between_shafts()) out.Put("to_z", PlaceOf(shafts, s.to_z));
  std::string list;
  for (const double v : s.speed) list += (list.empty() ? "" : ", ") + Float(v);
  if (s.varies()) out.text += fmt::format("speed = [{}]\n", list);
  if (s.varies() && s.cubic) out.Put("interpolation", std::string("cubic"));
  for (const Field<SupportCoefficients>& f : kSupportCoefficients) {
    if (!s.varies()) {
      if (s.*f.at != 0) out.Put(std::string(f.key).c_str(), s.*f.at);
      continue;
    }
    list.clear();
    bool some = false;
    for (const SupportCoefficients& row : s.table) {
      list += (list.empty() ? "" : ", ") + Float(row.*f.at);
      some = some || row.*f.at != 0;
    }
    if (some) out.text += fmt::format("{} = [{}]\n", f.key, list);
  }
}

void AddBodyLines(const BeamDefinition& d, ShaftLines& out) {
  const auto masses = [&](const auto& body) {
    out.Put("mass_x", body.mass_x);
    out.Put("mass_y", body.mass_y);
    out.Put("mass_z", body.mass_z);
  };
  for (const Housing& h : d.housings) {
    out.Table("housing");
    out.Put("name", h.name);
    masses(h);
  }
  for (const PointMass& m : d.masses) {
    out.Table("point_mass");
    out.Put("name", m.name);
    out.Put("shaft", m.shaft);
    out.Put("z", PlaceOf(d.shafts, m.z));
    masses(m);
  }
}

const char* YesNo(bool b) { return b ? "true" : "false"; }

}  // namespace

std::string BeamText(const BeamFile& file) {
  const BeamDefinition& d = file.definition;
  const BeamTheory& t = d.theory;
  ShaftLines out;
  out.text = fmt::format(
      "[rotor]\nkind = \"beam\"\nmodes = {}\nelements_per_section = {}\nmass = \"{}\"\nshear = "
      "{}\nrotary_inertia = "
      "{}\ngyroscopic = {}\nshear_coefficient = \"{}\"\n",
      file.modes, d.elements_per_section, t.mass == MassKind::kLumped ? "lumped" : "consistent",
      YesNo(t.shear), YesNo(t.rotary_inertia), YesNo(t.gyroscopic),
      t.coefficient == ShearCoefficient::kHutchinson ? "hutchinson" : "cowper");
  std::string list;
  for (const double zeta : file.modal_damping) list += (list.empty() ? "" : ", ") + Float(zeta);
  out.text +=
      fmt::format("modal_damping = {}\n", file.modal_damping.size() == 1 ? list : "[" + list + "]");
  std::vector<double> unnamed = d.stations;
  for (const ShaftPlane& p : file.planes) std::erase(unnamed, p.z);
  list.clear();
  for (const double z : unnamed) list += (list.empty() ? "" : ", ") + Float(z);
  if (!list.empty()) out.text += fmt::format("stations = [{}]\n", list);
  if (file.static_correction) out.text += "static_correction = true\n";
  if (t.separate_layers) out.text += "layers = \"separate\"\n";
  if (t.element == ElementKind::kThreeNode) out.text += "element = \"three_node\"\n";
  for (const PlacedShaft& s : d.shafts) {
    out.Table("shaft");
    out.Put("name", s.name);
  }
  for (const ShaftSection& s : d.sections) AddSectionLines(s, d.shafts, out);
  for (const Disk& disk : d.disks) AddDisk(disk, d.shafts, out);
  for (const ShaftPlane& p : file.planes) {
    const auto same = [&](const Disk& disk) { return disk.z == p.z; };
    if (std::any_of(d.disks.begin(), d.disks.end(), same)) continue;  // the disk carries the name
    out.Table("station");
    out.Put("name", p.name);
    if (const PlacedShaft* s = ShaftAt(d.shafts, p.z)) out.Put("shaft", s->name);
    out.Put("z", PlaceOf(d.shafts, p.z));
  }
  for (const SpringSupport& s : d.supports) AddSupportLines(s, d.shafts, out);
  AddBodyLines(d, out);
  return out.text;
}

void WriteBeam(const BeamFile& file, const std::string& path) {
  WriteFileAtomically(path, BeamText(file));
}

}  // namespace ambrig
