#include "rotor/shaft/beam_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

#include "core/base/counted.h"
#include "core/base/toml_checked.h"
#include "rotor/shaft/beam_mesh.h"
#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/shaft_file.h"
#include "rotor/shaft/shaft_parameters.h"

namespace ambrig {
namespace {

using Materials = std::map<std::string, Material>;

Materials ReadMaterials(const TomlTable& rotor, std::vector<Tolerance>* tolerances) {
  Materials out{{"steel", {2.11e11, 7810, 0.29926}},
                {"aluminium", {7.0e10, 2700, 0.33}},
                {"titanium", {1.14e11, 4430, 0.34}}};
  const auto table = rotor.Table("materials");
  if (!table) return out;
  for (const std::string& name : table->Keys()) {
    const TomlTable row = *table->Table(name);
    Material m;
    row.Read(m, kMaterialFields, tolerances);
    row.RejectUnknownKeys();
    out[name] = m;
  }
  return out;
}

/// `material = "name"`, overridden by E, rho, nu given beside it.
Material ReadMaterial(const TomlTable& row, const Materials& materials,
                      std::vector<Tolerance>* tolerances, bool mass_only) {
  Material m;
  if (mass_only) m.E = kMaterialFields[0].hi;  // carries nothing; any value passes the check
  if (row.Has("material")) {
    std::string names;
    for (const auto& [name, unused] : materials) names += (names.empty() ? "" : ", ") + name;
    m = materials.at(row.Choice("material", "", names));
  }
  row.Read(m, kMaterialFields, tolerances);
  return m;
}

/// Numbers that decide planes or shapes cannot be moved by a calibration.
void RejectSd(const TomlTable& row, std::initializer_list<const char*> keys,
              const std::vector<Tolerance>* tolerances) {
  for (const char* key : keys) {
    double sd = 0;
    row.Number(key, 0.0, &sd);
    if (tolerances && sd > 0) row.Fail(key, "has an sd, allowed: a plain number");
  }
}

constexpr Range kPlace{"m", -1e3, 1e3, "place on the shaft axis"};
constexpr Field<ShaftSection> kLeftEnd[] = {kShaftSectionFields[1], kShaftSectionFields[2]};
static_assert(kLeftEnd[0].key == std::string_view("od") &&
              kLeftEnd[1].key == std::string_view("id"));

ShaftTableSource SourceOf(const TomlTable& row) {
  const auto keys = row.Keys();
  return {row.path(), row.String("material", ""), {keys.begin(), keys.end()}, 0};
}

ShaftSection ReadSection(const TomlTable& row, const Materials& materials, bool stiff, double z0,
                         std::vector<Tolerance>* tolerances) {
  ShaftSection s;
  s.stiff = stiff;
  s.name = row.String("name", "");
  s.z0 = Within(row, "z0", stiff ? z0 : kRequired, kPlace);
  row.Read(s, kLeftEnd);  // the right end is the same unless given
  s.od_right = s.od;
  s.id_right = s.id;
  row.Read(s, kShaftSectionFields, tolerances);
  s.material = ReadMaterial(row, materials, tolerances, !stiff);
  RejectSd(row, {"z0"}, tolerances);
  row.RejectUnknownKeys();
  const std::string problem = SectionProblem(s);
  if (!problem.empty()) row.Fail("id", problem);
  return s;
}

Disk ReadDisk(const TomlTable& row, const Materials& materials, std::vector<Tolerance>* tolerances,
              double* rho) {
  // Both spellings first: a misspelt `width` must not end as a missing mass.
  for (const char* key : {"z", "mass", "inertia_diametral", "inertia_polar", "width", "od", "id",
                          "material", "rho", "name"})
    row.Has(key);
  row.RejectUnknownKeys();
  Disk d;
  if (row.Has("width")) {
    for (const char* key : {"mass", "inertia_diametral", "inertia_polar"})
      if (row.Has(key))
        row.Fail(key, "is given beside width, allowed: either mass and inertias or width, od, id");
    constexpr Range kSize{"m", 0, 100, "size of the disk"};
    const double width = Within(row, "width", kRequired, kSize),
                 od = Within(row, "od", kRequired, kSize), id = Within(row, "id", 0.0, kSize);
    if (!(width > 0)) row.Fail("width", fmt::format("{} m, allowed above 0", NumberText(width)));
    if (!(id >= 0 && od > id))
      row.Fail("od", fmt::format("{} m, allowed above id = {} m", NumberText(od), NumberText(id)));
    RejectSd(row, {"width", "od", "id"}, tolerances);
    *rho = ReadMaterial(row, materials, tolerances, true).rho;
    d = DiskFromGeometry(0, width, id, od, *rho);
    d.z = kRequired;
  }
  row.Read(d, kDiskFields, tolerances);
  d.name = row.String("name", "");
  // A body's own second moments: Ip <= Id_1 + Id_2.
  if (d.inertia_polar > 2 * d.inertia_diametral * (1 + 1e-9))
    row.Fail("inertia_polar",
             fmt::format("{} kg m2, allowed up to twice inertia_diametral = {} kg m2",
                         NumberText(d.inertia_polar), NumberText(d.inertia_diametral)));
  return d;
}

SpringSupport ReadSupport(const TomlTable& row, std::vector<Tolerance>* tolerances) {
  SpringSupport s =
      IsotropicSupport(kRequired, Within(row, "k", 0.0, {"N/m", -1e15, 1e15, "stiffness"}),
                       Within(row, "c", 0.0, {"N s/m", -1e12, 1e12, "damping"}));
  row.Read(s, kSpringSupportFields, tolerances);
  s.name = row.String("name", "");
  row.RejectUnknownKeys();
  return s;
}

int ReadCount(const TomlTable& rotor, const char* key, int fallback, int lo, int hi) {
  const long long n = rotor.Integer(key, fallback);
  if (n < lo || n > hi) rotor.Fail(key, fmt::format("{}, allowed {} to {}", n, lo, hi));
  return static_cast<int>(n);
}

BeamTheory ReadTheory(const TomlTable& rotor, BeamTheory t) {
  const char* before = t.mass == MassKind::kLumped ? "lumped" : "consistent";
  const bool lumped = rotor.Choice("mass", before, "consistent, lumped") == "lumped";
  t.mass = lumped ? MassKind::kLumped : MassKind::kConsistent;
  t.shear = rotor.Bool("shear", t.shear);
  t.rotary_inertia = rotor.Bool("rotary_inertia", t.rotary_inertia);
  t.gyroscopic = rotor.Bool("gyroscopic", t.gyroscopic);
  const char* now = t.coefficient == ShearCoefficient::kHutchinson ? "hutchinson" : "cowper";
  const bool hutchinson =
      rotor.Choice("shear_coefficient", now, "cowper, hutchinson") == "hutchinson";
  t.coefficient = hutchinson ? ShearCoefficient::kHutchinson : ShearCoefficient::kCowper;
  return t;
}

/// The field of `modal_damping` when it is one number, which may have an sd.
struct OneDamping {
  double zeta = 0;
};
constexpr Field<OneDamping> kOneDamping[] = {
    {"modal_damping", &OneDamping::zeta, "-", -kInfinity, kInfinity, "ratio of every mode"}};

std::vector<double> ReadDamping(const TomlTable& rotor, std::vector<double> zeta, int modes,
                                std::vector<Tolerance>* tolerances) {
  if (rotor.IsArray("modal_damping")) {
    zeta = rotor.Numbers("modal_damping");
  } else if (rotor.Has("modal_damping")) {
    OneDamping one;
    rotor.Read(one, kOneDamping, tolerances);
    zeta = {one.zeta};
  }
  if (zeta.size() != 1 && static_cast<int>(zeta.size()) != modes)
    rotor.Fail("modal_damping", fmt::format("{}, allowed: one, or one per mode ({})",
                                            Counted(zeta.size(), "value"), modes));
  for (double z : zeta)
    if (!(z >= 0 && z < 1))
      rotor.Fail("modal_damping", fmt::format("{}, allowed 0 to below 1", NumberText(z)));
  return zeta;
}

void ReadTables(const TomlTable& rotor, BeamFile& out, std::vector<Tolerance>* tolerances) {
  BeamDefinition& d = out.definition;
  const Materials materials = ReadMaterials(rotor, tolerances);
  for (const auto& [name, material] : materials) out.materials[name] = material;
  out.section_sources.resize(d.sections.size());  // ROSS's have none
  out.disk_sources.resize(d.disks.size());
  double z = 0;
  for (const TomlTable& row : rotor.Tables("section")) {
    d.sections.push_back(ReadSection(row, materials, true, z, tolerances));
    out.section_sources.push_back(SourceOf(row));
    z = d.sections.back().z0 + d.sections.back().length;
  }
  for (const TomlTable& row : rotor.Tables("sleeve")) {
    d.sections.push_back(ReadSection(row, materials, false, 0, tolerances));
    out.section_sources.push_back(SourceOf(row));
  }
  for (const TomlTable& row : rotor.Tables("disk")) {
    ShaftTableSource source = SourceOf(row);
    d.disks.push_back(ReadDisk(row, materials, tolerances, &source.rho));
    out.disk_sources.push_back(std::move(source));
  }
  for (const TomlTable& row : rotor.Tables("support"))
    d.supports.push_back(ReadSupport(row, tolerances));
  for (double station : AllWithin(rotor, "stations", {}, kPlace)) d.stations.push_back(station);
}

void AddPlane(const TomlTable& row, const std::string& name, double z, BeamFile& out) {
  if (name.empty()) return;
  if (name.find_first_of(". \t") != std::string::npos)
    row.Fail("name", fmt::format("= \"{}\", allowed: a name without dots and blanks", name));
  for (const ShaftPlane& p : out.planes)
    if (p.name == name)
      row.Fail("name", fmt::format("= \"{}\" is taken, allowed: another name", name));
  out.planes.push_back({name, z});
}

void ReadPlanes(const TomlTable& rotor, BeamFile& out, const std::vector<Tolerance>* tolerances) {
  for (const TomlTable& row : rotor.Tables("disk"))
    AddPlane(row, row.String("name", ""), Within(row, "z", kRequired, kPlace), out);
  for (const TomlTable& row : rotor.Tables("station")) {
    RejectSd(row, {"z"}, tolerances);
    const double z = Within(row, "z", kRequired, kPlace);
    AddPlane(row, row.String("name"), z, out);
    row.RejectUnknownKeys();
    out.definition.stations.push_back(z);
  }
}

/// The tables of one [rotor], in the rig's file or in the shaft's own; what is absent stays as it
/// was.
void ReadOwnTable(const TomlTable& rotor, BeamFile& out, std::vector<Tolerance>* tolerances) {
  rotor.Choice("kind", "beam", "beam");
  BeamDefinition& d = out.definition;
  ReadTables(rotor, out, tolerances);
  ReadPlanes(rotor, out, tolerances);
  d.theory = ReadTheory(rotor, d.theory);
  d.elements_per_section =
      ReadCount(rotor, "elements_per_section", d.elements_per_section, 1, 1000);
  out.modes = ReadCount(rotor, "modes", out.modes, 0, 100);
  out.modal_damping = ReadDamping(rotor, out.modal_damping, out.modes, tolerances);
}

void FromRoss(const std::string& file, const std::function<void(const std::string&, double)>& add,
              BeamFile& out, std::vector<std::string>* ignored) {
  RossRotor ross = ReadRoss(file);
  out.definition = std::move(ross.definition);
  if (ignored) *ignored = ross.ignored;
  for (const Disk& d : out.definition.disks) {
    std::string name = d.name;  // ROSS's names have blanks: "Disk 0"
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '.' || c == ' ' || c == '\t'; }, '_');
    add(name, d.z);
  }
}

/// A table's own file: ROSS's, or one with a [rotor] of the same tables.
void ReadShaftFile(const TomlTable& rotor, BeamFile& out, std::vector<Tolerance>* tolerances) {
  if (rotor.Has("section")) rotor.Fail("section", "is given beside file, allowed: one of them");
  const std::filesystem::path given = rotor.String("file");
  if (given.extension() != ".toml" && given.extension() != ".json")
    rotor.Fail("file", fmt::format("= \"{}\", allowed: a .toml or .json file", given.string()));
  const std::string file = ExistingFile(rotor, "file");
  if (given.extension() == ".toml") {
    const TomlTable root = TomlTable::FromFile(file);
    if (const auto own = root.Table("rotor")) {
      ReadOwnTable(*own, out, tolerances);
      own->RejectUnknownKeys();
      root.RejectUnknownKeys();
      return;
    }
  }
  FromRoss(
      file, [&](const std::string& name, double z) { AddPlane(rotor, name, z, out); }, out,
      nullptr);
}

}  // namespace

BeamFile ReadBeam(const TomlTable& rotor, std::vector<Tolerance>* tolerances) {
  rotor.Choice("kind", "beam", "beam");
  BeamFile out;
  out.modes = 2;
  out.modal_damping = {0.0};
  std::vector<Tolerance> found;
  if (rotor.Has("file")) ReadShaftFile(rotor, out, tolerances ? &found : nullptr);
  ReadOwnTable(rotor, out, tolerances ? &found : nullptr);
  out.parameters = FindShaftParameters(rotor, out, found);
  if (tolerances) tolerances->insert(tolerances->end(), found.begin(), found.end());
  BeamDefinition& d = out.definition;
  if (d.sections.empty())
    rotor.Fail("section", "is missing, allowed: tables, each written [[rotor.section]]");
  BeamMesh mesh;
  try {
    mesh = MakeMesh(d);
  } catch (const InputError& e) {
    rotor.Fail("", e.what());
  }
  const int available = 2 * static_cast<int>(mesh.z.size()) - 2;
  if (out.modes > available)
    rotor.Fail("modes",
               fmt::format("{}, allowed 0 to {} with these elements", out.modes, available));
  return out;
}

BeamFile ReadShaft(const std::string& file, bool* ross, std::vector<std::string>* ignored) {
  *ross = true;
  if (file.ends_with(".toml")) {
    const TomlTable root = TomlTable::FromFile(file);
    if (const auto own = root.Table("rotor")) {
      *ross = false;
      return ReadBeam(*own);
    }
  } else if (!file.ends_with(".json")) {
    throw InputError(fmt::format("{}: allowed: a .toml or .json file", file));
  }
  BeamFile out;
  out.modes = 2;
  out.modal_damping = {0.0};
  FromRoss(
      file,
      [&](const std::string& name, double z) {
        if (!name.empty()) out.planes.push_back({name, z});
      },
      out, ignored);
  return out;
}

ReducedRotor BuildReduced(const BeamFile& file) {
  return Reduce(BuildBeam(file.definition), file.modes, file.modal_damping);
}

}  // namespace ambrig
