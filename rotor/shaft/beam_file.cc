#include "rotor/shaft/beam_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

#include "core/base/counted.h"
#include "core/base/toml_checked.h"
#include "rotor/shaft/beam_mesh.h"
#include "rotor/shaft/beam_theory_file.h"
#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/shaft_file.h"
#include "rotor/shaft/shaft_parameters.h"
#include "rotor/shaft/shaft_tables.h"
#include "rotor/shaft/support_tables.h"

namespace ambrig {
namespace {

int ReadCount(const TomlTable& rotor, const char* key, int fallback, int lo, int hi) {
  const long long n = rotor.Integer(key, fallback);
  if (n < lo || n > hi) rotor.Fail(key, fmt::format("{}, allowed {} to {}", n, lo, hi));
  return static_cast<int>(n);
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

/// The shaft that a part belongs to; the first unless said.
std::string ReadShaftOf(const TomlTable& row, const std::vector<PlacedShaft>& shafts,
                        const char* key = "shaft") {
  if (shafts.empty()) return "";
  std::string names;
  for (const PlacedShaft& s : shafts) names += (names.empty() ? "" : ", ") + s.name;
  return row.Choice(key, shafts.front().name.c_str(), names.c_str());
}

void ReadShafts(const TomlTable& rotor, BeamDefinition& d) {
  const std::vector<TomlTable> rows = rotor.Tables("shaft");
  if (!rows.empty() && !d.sections.empty())
    rotor.Fail("shaft", "is given beside file, allowed: one of them");
  for (const TomlTable& row : rows) {
    PlacedShaft s;
    s.name = row.String("name");
    for (const PlacedShaft& other : d.shafts)
      if (other.name == s.name)
        row.Fail("name", fmt::format("= \"{}\" is taken, allowed: another name", s.name));
    if (s.name.empty() || s.name.find_first_of(", /:@") != std::string::npos)
      row.Fail("name", fmt::format("= \"{}\", allowed: a name without blanks and , / : @", s.name));
    row.RejectUnknownKeys();
    d.shafts.push_back(s);
  }
  if (d.shafts.size() == 1) rotor.Fail("shaft", "stands once, allowed: none, or two or more");
}

/// Supports, what they stand on, masses.
void ReadSupports(const TomlTable& rotor, BeamFile& out, std::vector<Tolerance>* tolerances) {
  BeamDefinition& d = out.definition;
  out.support_sources.resize(d.supports.size());
  for (const TomlTable& row : rotor.Tables("support")) {
    const std::string shaft = ReadShaftOf(row, d.shafts);
    const std::string to = row.Has("to") ? ReadShaftOf(row, d.shafts, "to") : "";
    d.supports.push_back(ReadSupport(row, tolerances));
    d.supports.back().shaft = d.supports.back().on_shaft() ? shaft : "";
    d.supports.back().to = to;
    out.support_sources.push_back(SourceOf(row));
  }
  for (const TomlTable& row : rotor.Tables("housing")) d.housings.push_back(ReadHousing(row));
  for (const TomlTable& row : rotor.Tables("point_mass")) {
    const std::string shaft = ReadShaftOf(row, d.shafts);
    d.masses.push_back(ReadPointMass(row));
    d.masses.back().shaft = shaft;
  }
}

/// Pieces of a shaft follow one another, each shaft from its own left end.
void ReadSections(const TomlTable& rotor, const Materials& materials, BeamFile& out,
                  std::vector<Tolerance>* tolerances) {
  BeamDefinition& d = out.definition;
  std::map<std::string, double> ends;
  for (const char* kind : {"section", "sleeve"})
    for (const TomlTable& row : rotor.Tables(kind)) {
      const bool stiff = *(kind + 1) == 'e';
      const std::string shaft = ReadShaftOf(row, d.shafts);
      d.sections.push_back(ReadSection(row, materials, stiff, ends[shaft], tolerances));
      d.sections.back().shaft = shaft;
      out.section_sources.push_back(SourceOf(row));
      if (stiff) ends[shaft] = d.sections.back().z0 + d.sections.back().length;
    }
}

void ReadTables(const TomlTable& rotor, BeamFile& out, std::vector<Tolerance>* tolerances) {
  BeamDefinition& d = out.definition;
  const Materials materials = ReadMaterials(rotor, tolerances);
  for (const auto& [name, material] : materials) out.materials[name] = material;
  out.section_sources.resize(d.sections.size());  // ROSS's have none
  out.disk_sources.resize(d.disks.size());
  ReadShafts(rotor, d);
  ReadSections(rotor, materials, out, tolerances);
  for (const TomlTable& row : rotor.Tables("disk")) {
    ShaftTableSource source = SourceOf(row);
    const std::string shaft = ReadShaftOf(row, d.shafts);
    d.disks.push_back(ReadDisk(row, materials, tolerances, &source.rho));
    d.disks.back().shaft = shaft;
    out.disk_sources.push_back(std::move(source));
  }
  ReadSupports(rotor, out, tolerances);
  for (double station : AllWithin(rotor, "stations", {}, kPlaceOnShaft))
    d.stations.push_back(station);
  try {
    if (!rotor.Tables("shaft").empty()) LayOutShafts(d);
  } catch (const InputError& e) {
    rotor.Fail("shaft", e.what());
  }
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

double NodePlaceOf(const TomlTable& row, const std::vector<PlacedShaft>& shafts) {
  return NodePlace(shafts, ReadShaftOf(row, shafts), Within(row, "z", kRequired, kPlaceOnShaft));
}

void ReadPlanes(const TomlTable& rotor, BeamFile& out, const std::vector<Tolerance>* tolerances) {
  for (const TomlTable& row : rotor.Tables("disk"))
    AddPlane(row, row.String("name", ""), NodePlaceOf(row, out.definition.shafts), out);
  for (const TomlTable& row : rotor.Tables("station")) {
    RejectSd(row, {"z"}, tolerances);
    const double z = NodePlaceOf(row, out.definition.shafts);
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
  out.static_correction = rotor.Bool("static_correction", out.static_correction);
  out.modal_damping = ReadDamping(rotor, out.modal_damping, out.modes, tolerances);
}

void FromRoss(const std::string& file, const std::function<void(const std::string&, double)>& add,
              BeamFile& out, std::vector<std::string>* ignored, std::vector<RossMagnet>* magnets) {
  RossRotor ross = ReadRoss(file);
  out.definition = std::move(ross.definition);
  if (ignored) *ignored = ross.ignored;
  if (magnets) *magnets = ross.magnetic_bearings;
  for (const RossMagnet& m : ross.magnetic_bearings)
    if (ignored && !magnets)
      ignored->push_back(fmt::format(
          "{} at {}: a magnetic bearing (ambrig rotor convert makes a rig of it), its plane kept "
          "as a station",
          m.name, PlaceText(out.definition.shafts, m.z)));
  const auto named = [&](std::string name, double z) {  // ROSS's names have blanks: "Disk 0"
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '.' || c == ' ' || c == '\t'; }, '_');
    add(name, z);
  };
  for (const Disk& d : out.definition.disks) named(d.name, d.z);
  for (const RossMagnet& b : ross.magnetic_bearings) named(b.name, b.z);
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
      file, [&](const std::string& name, double z) { AddPlane(rotor, name, z, out); }, out, nullptr,
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
  CheckHousings(rotor, d);
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

BeamFile ReadShaft(const std::string& file, bool* ross, std::vector<std::string>* ignored,
                   std::vector<Tolerance>* tolerances, std::vector<RossMagnet>* magnets) {
  *ross = true;
  if (file.ends_with(".toml")) {
    const TomlTable root = TomlTable::FromFile(file);
    if (const auto own = root.Table("rotor")) {
      *ross = false;
      return ReadBeam(*own, tolerances);
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
      out, ignored, magnets);
  return out;
}

ReducedRotor BuildReduced(const BeamFile& file, const std::vector<double>& stations) {
  return Reduce(BuildBeam(file.definition), file.modes, file.modal_damping, stations);
}

}  // namespace ambrig
