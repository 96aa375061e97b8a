#include "rotor/shaft/shaft_parameters.h"

#include <fmt/format.h>

#include <algorithm>

namespace ambrig {

namespace {

constexpr double kApart = 1e-4;  // of a diameter, that od stays above id

template <class P, std::size_t n>
const Field<P>* FieldNamed(const Field<P> (&fields)[n], const std::string& key) {
  for (const Field<P>& f : fields)
    if (f.key == key) return &f;
  return nullptr;
}

template <class P>
void Take(const Field<P>& f, const P& p, ShaftParameter& out) {
  out.value = p.*f.at;
  out.lo = f.lo;
  out.hi = f.hi;
  out.unit = f.unit;
}

/// A part's own number, or what its material says.
bool Own(const ShaftTableSource& s, const std::string& key) { return s.keys.count(key) > 0; }

/// Mass and inertias of a disk given by its geometry are proportional to its density.
void ScaleDisk(std::size_t k, const BeamFile& file, double rho, ShaftParameter& out) {
  const Disk d = file.definition.disks[k];
  out.set.push_back([k, d, rho](BeamFile& to, double value) {
    Disk& disk = to.definition.disks[k];
    disk.mass = d.mass * value / rho;
    disk.inertia_diametral = d.inertia_diametral * value / rho;
    disk.inertia_polar = d.inertia_polar * value / rho;
  });
}

bool OfMaterial(const std::string& name, const std::string& key, const BeamFile& file,
                ShaftParameter& out) {
  const Field<Material>* f = FieldNamed(kMaterialFields, key);
  const auto material = file.materials.find(name);
  if (!f || material == file.materials.end()) return false;
  Take(*f, material->second, out);
  const auto at = f->at;
  for (std::size_t k = 0; k < file.section_sources.size(); ++k)
    if (const ShaftTableSource& s = file.section_sources[k]; s.material == name && !Own(s, key))
      out.set.push_back(
          [k, at](BeamFile& to, double value) { to.definition.sections[k].material.*at = value; });
  for (std::size_t k = 0; key == "rho" && k < file.disk_sources.size(); ++k)
    if (const ShaftTableSource& s = file.disk_sources[k]; s.material == name && !Own(s, key))
      ScaleDisk(k, file, out.value, out);
  return true;
}

bool OfSection(std::size_t k, const std::string& key, const BeamFile& file, ShaftParameter& out) {
  const ShaftSection& section = file.definition.sections[k];
  const ShaftTableSource& source = file.section_sources[k];
  if (const Field<Material>* f = FieldNamed(kMaterialFields, key)) {
    Take(*f, section.material, out);
    out.set.push_back([k, at = f->at](BeamFile& to, double value) {
      to.definition.sections[k].material.*at = value;
    });
    return true;
  }
  const Field<ShaftSection>* f = FieldNamed(kShaftSectionFields, key);
  if (!f || key == "length") return false;
  Take(*f, section, out);
  out.set.push_back(
      [k, at = f->at](BeamFile& to, double value) { to.definition.sections[k].*at = value; });
  const std::string right = key + "_right";
  if (const Field<ShaftSection>* other = FieldNamed(kShaftSectionFields, right);
      other && !Own(source, right))
    out.set.push_back(
        [k, at = other->at](BeamFile& to, double value) { to.definition.sections[k].*at = value; });
  // A bore stays inside its shaft.
  if (key == "od") out.lo = std::max(out.lo, section.id * (1 + kApart));
  if (key == "od_right") out.lo = std::max(out.lo, section.id_right * (1 + kApart));
  if (key == "id") out.hi = std::min(out.hi, section.od * (1 - kApart));
  if (key == "id_right") out.hi = std::min(out.hi, section.od_right * (1 - kApart));
  return true;
}

bool OfDisk(std::size_t k, const std::string& key, const BeamFile& file, ShaftParameter& out) {
  if (key == "rho") {
    const double rho = file.disk_sources[k].rho;
    Take(*FieldNamed(kMaterialFields, key), Material{0, rho, 0}, out);
    ScaleDisk(k, file, rho, out);
    return true;
  }
  const Field<Disk>* f = FieldNamed(kDiskFields, key);
  if (!f || key == "z") return false;
  Take(*f, file.definition.disks[k], out);
  out.set.push_back(
      [k, at = f->at](BeamFile& to, double value) { to.definition.disks[k].*at = value; });
  return true;
}

bool OfSupport(std::size_t k, const std::string& key, const BeamFile& file, ShaftParameter& out) {
  const SpringSupport& s = file.definition.supports[k];
  const bool isotropic = key == "k" || key == "c";
  const Field<SupportCoefficients>* f =
      FieldNamed(kSupportCoefficients, isotropic ? key + "xx" : key);
  if (!f || s.varies()) return false;
  Take<SupportCoefficients>(*f, s, out);
  const auto at = f->at;
  out.set.push_back([k, at](BeamFile& to, double value) { to.definition.supports[k].*at = value; });
  if (!isotropic) return true;
  const auto other = FieldNamed(kSupportCoefficients, key + "yy")->at;
  out.set.push_back(
      [k, other](BeamFile& to, double value) { to.definition.supports[k].*other = value; });
  return true;
}

bool Find(const BeamFile& file, const std::string& path, ShaftParameter& out) {
  const std::size_t dot = path.rfind('.');
  const std::string table = path.substr(0, dot), key = path.substr(dot + 1),
                    materials = "rotor.materials.";
  if (path == "rotor.modal_damping") {
    out.value = file.modal_damping[0];
    out.lo = 0;
    out.hi = 0.999;
    out.unit = "-";
    out.set.push_back([](BeamFile& to, double value) { to.modal_damping = {value}; });
    return true;
  }
  if (table.starts_with(materials))
    return OfMaterial(table.substr(materials.size()), key, file, out);
  for (std::size_t k = 0; k < file.section_sources.size(); ++k)
    if (file.section_sources[k].path == table) return OfSection(k, key, file, out);
  for (std::size_t k = 0; k < file.disk_sources.size(); ++k)
    if (file.disk_sources[k].path == table) return OfDisk(k, key, file, out);
  for (std::size_t k = 0; k < file.support_sources.size(); ++k)
    if (file.support_sources[k].path == table) return OfSupport(k, key, file, out);
  return false;
}

}  // namespace

std::vector<ShaftParameter> FindShaftParameters(const TomlTable& rotor, const BeamFile& file,
                                                const std::vector<Tolerance>& tolerances) {
  std::vector<ShaftParameter> out;
  for (const Tolerance& t : tolerances) {
    ShaftParameter p;
    p.path = t.path;
    for (const ShaftParameter& other : out)
      if (other.path == t.path)
        rotor.Fail("", fmt::format("{} has an sd in two files, allowed: one", t.path));
    if (!Find(file, t.path, p))
      rotor.Fail("", fmt::format("{} has an sd, allowed: diameters, damping and materials of "
                                 "sections and sleeves, mass and inertias "
                                 "of disks, constant coefficients of supports, one modal_damping",
                                 t.path));
    out.push_back(std::move(p));
  }
  return out;
}

void SetShaftParameter(BeamFile& file, std::size_t index, double value) {
  ShaftParameter& p = file.parameters.at(index);
  p.value = value;
  const auto all = p.set;  // they get the file they are stored in
  for (const auto& set : all) set(file, value);
}

}  // namespace ambrig
