#include "rotor/shaft/shaft_tables.h"

#include <fmt/format.h>

#include "rotor/shaft/beam_mesh.h"

namespace ambrig {
namespace {

/// Without mass a place of the shaft has no equation of motion; 0 and -0 are inside
/// the closed range.
void RequireMass(const TomlTable& row, const Material& m) {
  if (!(m.rho > 0))
    row.Fail("rho", "= 0 kg/m3, allowed: above 0 (0.001 is next to nothing and has a solution)");
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
  RequireMass(row, m);
  return m;
}

constexpr Field<ShaftSection> kLeftEnd[] = {kShaftSectionFields[1], kShaftSectionFields[2]};
static_assert(kLeftEnd[0].key == std::string_view("od") &&
              kLeftEnd[1].key == std::string_view("id"));

}  // namespace

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
    RequireMass(row, m);
    out[name] = m;
  }
  return out;
}

void RejectSd(const TomlTable& row, std::initializer_list<const char*> keys,
              const std::vector<Tolerance>* tolerances) {
  for (const char* key : keys) {
    double sd = 0;
    row.Number(key, 0.0, &sd);
    if (tolerances && sd > 0) row.Fail(key, "has an sd, allowed: a plain number");
  }
}

ShaftTableSource SourceOf(const TomlTable& row) {
  const auto keys = row.Keys();
  return {row.path(), row.String("material", ""), {keys.begin(), keys.end()}, 0};
}

ShaftSection ReadSection(const TomlTable& row, const Materials& materials, bool stiff, double z0,
                         std::vector<Tolerance>* tolerances) {
  ShaftSection s;
  s.stiff = stiff;
  s.name = row.String("name", "");
  s.z0 = Within(row, "z0", stiff ? z0 : kRequired, kPlaceOnShaft);
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
                          "material", "rho", "name", "shaft"})
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

}  // namespace ambrig
