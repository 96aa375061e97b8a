#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/base/atomic_file.h"
#include "rotor/shaft/beam_mesh.h"
#include "rotor/shaft/ross_file.h"

namespace ambrig {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSleeveEWritten =
    1.0;  // [Pa]; E > 0 because ROSS derives Poisson's ratio from E and G_s

Json MaterialTable(const ShaftSection& s) {
  const double E = s.stiff ? s.material.E : kSleeveEWritten;
  return {{"name", s.stiff ? "shaft" : "sleeve"},
          {"rho", s.material.rho},
          {"E", E},
          {"G_s", E / (2 * (1 + s.material.nu))},
          {"color", s.stiff ? "#525252" : "#b0b0b0"}};
}

Json ShaftTable(const ShaftSection& s, const BeamTheory& t, int node, const std::string& tag) {
  Json table = {
      {"L", s.length},
      {"idl", s.id},
      {"odl", s.od},
      {"idr", s.id_right},
      {"odr", s.od_right},
      {"n", node},
      {"axial_force", s.axial_force},
      {"torque", s.torque},
      {"shear_effects", t.shear},
      {"rotary_inertia", t.rotary_inertia},
      {"gyroscopic", t.gyroscopic},
      {"shear_method_calc", t.coefficient == ShearCoefficient::kCowper ? "cowper" : "hutchinson"},
      {"tag", tag},
      {"material", MaterialTable(s)}};
  // Unknown to the first files of version 1, which hold no damping of a shaft.
  if (s.damping_mass != 0 || s.damping_stiffness != 0) {
    table["alpha"] = s.damping_mass;
    table["beta"] = s.damping_stiffness;
  }
  return table;
}

Json BearingTable(const SpringSupport& s, int node, const std::string& tag) {
  Json table = {{"n", node}, {"tag", tag}};
  if (s.varies()) table["frequency"] = s.speed;
  for (const Field<SupportCoefficients>& f : kSupportCoefficients) {
    Json values = Json::array();
    if (f.key[1] == 'r') continue;                                    // not ROSS's
    bool some = f.key[0] != 'm' && f.key != "kzz" && f.key != "czz";  // the others are younger keys
    for (const SupportCoefficients& c :
         s.varies() ? s.table : std::vector<SupportCoefficients>{s}) {
      values.push_back(c.*f.at);
      some = some || c.*f.at != 0;
    }
    if (some) table[std::string(f.key)] = values;
  }
  return table;
}

constexpr double SupportCoefficients::*kTurning[] = {
    &SupportCoefficients::krx, &SupportCoefficients::kry, &SupportCoefficients::krz,
    &SupportCoefficients::crx, &SupportCoefficients::cry, &SupportCoefficients::crz};

bool Turns(const SpringSupport& s) {
  for (const SupportCoefficients& c : s.varies() ? s.table : std::vector<SupportCoefficients>{s})
    for (const auto at : kTurning)
      if (c.*at != 0) return true;
  return false;
}

/// A constant support from the right end of a shaft to the left end of the next, which ROSS has
/// as an element.
bool IsCoupling(const SpringSupport& s, const BeamRotor& nodes) {
  return s.between_shafts() && !s.varies() && Turns(s) &&
         NodeAt(nodes, s.to_z) == NodeAt(nodes, s.z) + 1 && s.kxy == 0 && s.kyx == 0 &&
         s.cxy == 0 && s.cyx == 0 && !s.has_mass();
}

Json CouplingTable(const SpringSupport& s, const std::vector<PlacedShaft>& shafts, int node,
                   const std::string& tag) {
  return {{"n", node},
          {"tag", tag},
          {"m_l", 0.0},
          {"m_r", 0.0},
          {"Ip_l", 0.0},
          {"Ip_r", 0.0},
          {"kt_x", s.kxx},
          {"kt_y", s.kyy},
          {"kt_z", s.kzz},
          {"kr_x", s.krx},
          {"kr_y", s.kry},
          {"kr_z", s.krz},
          {"ct_x", s.cxx},
          {"ct_y", s.cyy},
          {"ct_z", s.czz},
          {"cr_x", s.crx},
          {"cr_y", s.cry},
          {"cr_z", s.crz},
          {"L", PlaceOf(shafts, s.to_z) - PlaceOf(shafts, s.z)}};
}

/// A tag that no element has yet: ROSS takes no two of one tag, a disk and a bearing neither.
class Tags {
 public:
  std::string Of(const std::string& kind, const std::string& name) {
    std::string tag = name;
    for (int count = 0; tag.empty() || !taken_.insert(tag).second; ++count)
      tag = fmt::format("{} {}", name.empty() ? kind : name, count);
    return tag;
  }

 private:
  std::set<std::string> taken_;
};

/// Housings are ROSS's nodes after those of the shaft, each with a point mass.
int HousingNode(const BeamDefinition& d, const BeamRotor& nodes, const std::string& name) {
  std::size_t k = 0;
  while (d.housings[k].name != name) ++k;
  return static_cast<int>(nodes.z.size() + k);
}

void AddBearings(const BeamDefinition& d, const BeamRotor& nodes, Tags& tags, Json& root) {
  const auto mass = [&](int node, const auto& body) {
    const std::string tag = tags.Of("Mass", body.name);
    root["PointMass_" + tag] = {
        {"n", node}, {"mx", body.mass_x}, {"my", body.mass_y}, {"mz", body.mass_z}, {"tag", tag}};
  };
  for (const SpringSupport& s : d.supports) {
    if (IsCoupling(s, nodes)) {
      const std::string coupling = tags.Of("Coupling", s.name);
      root["CouplingElement_" + coupling] =
          CouplingTable(s, d.shafts, NodeAt(nodes, s.z), coupling);
      continue;
    }
    const std::string tag = tags.Of("Bearing", s.name);
    const int node = s.on_shaft() ? NodeAt(nodes, s.z) : HousingNode(d, nodes, s.carries);
    Json& table = root["BearingElement_" + tag] = BearingTable(s, node, tag);
    if (!s.on.empty()) table["n_link"] = HousingNode(d, nodes, s.on);
    if (s.between_shafts()) table["n_link"] = NodeAt(nodes, s.to_z);
  }
  for (const PointMass& p : d.masses) mass(NodeAt(nodes, p.z), p);
  for (const Housing& h : d.housings) mass(HousingNode(d, nodes, h.name), h);
}

std::vector<std::string> UnknownToRoss(const BeamDefinition& d) {
  std::vector<std::string> lost;
  const BeamMesh mesh = MakeMesh(d);
  BeamRotor nodes;
  nodes.z = mesh.z;
  for (const SpringSupport& s : d.supports)
    if (Turns(s) && !IsCoupling(s, nodes))
      lost.push_back(
          fmt::format("stiffness or damping against rotation of support \"{}\"", s.name));
  for (const ShaftElement& e : mesh.elements)
    if (e.layers.size() > 1 && !d.theory.separate_layers) {
      lost.push_back("layers = \"joined\": ROSS takes each layer as an element of its own");
      break;
    }
  if (d.theory.mass == MassKind::kLumped)
    lost.push_back("mass = \"lumped\": ROSS takes consistent masses, frequencies differ");
  if (d.theory.element == ElementKind::kThreeNode)
    lost.push_back("element = \"three_node\": each becomes two of ROSS's elements of two nodes");
  for (const SpringSupport& s : d.supports)
    if (s.varies() && !s.cubic && s.speed.size() > 2)
      lost.push_back(
          fmt::format("straight lines between the {} speeds of support \"{}\": ROSS draws "
                      "splines",
                      s.speed.size(), s.name));
  return lost;
}

Json MagnetTable(const RossMagnet& m, int node, const std::string& tag) {
  return {{"n", node},      {"g0", m.gap},      {"i0", m.bias},   {"ag", m.area},
          {"nw", m.turns},  {"alpha", m.alpha}, {"k_amp", 1.0},   {"k_sense", 1.0},
          {"kp_pid", m.kp}, {"kd_pid", m.kd},   {"ki_pid", m.ki}, {"n_f", m.cutoff},
          {"tag", tag}};
}

Json RotorTables(const BeamDefinition& d, const std::vector<RossMagnet>& magnets) {
  const BeamMesh mesh = MakeMesh(d);
  BeamRotor nodes;
  nodes.z = mesh.z;
  Json root = {{"parameters", Json::object()}};
  Tags tags;
  for (std::size_t i = 0; i < mesh.elements.size(); ++i)
    for (const ShaftSection& layer : mesh.elements[i].layers) {
      const std::string tag = tags.Of("Shaft Element", "");
      root["ShaftElement_" + tag] = ShaftTable(layer, d.theory, static_cast<int>(i), tag);
    }
  for (const Disk& disk : d.disks) {
    const std::string tag = tags.Of("Disk", disk.name);
    root["DiskElement_" + tag] = {{"n", NodeAt(nodes, disk.z)},
                                  {"m", disk.mass},
                                  {"Id", disk.inertia_diametral},
                                  {"Ip", disk.inertia_polar},
                                  {"tag", tag}};
  }
  AddBearings(d, nodes, tags, root);
  for (const RossMagnet& m : magnets) {
    const std::string tag = tags.Of("Magnet", m.name);
    root["MagneticBearingElement_" + tag] = MagnetTable(m, NodeAt(nodes, m.z), tag);
  }
  return root;
}

/// JSON strings and numbers are TOML values too; json.dump gives the shortest text that reads back.
void WriteTable(std::ostream& out, const std::string& header, const Json& table) {
  out << "\n[" << header << "]\n";
  for (const auto& [key, value] : table.items())
    if (!value.is_object()) out << key << " = " << value.dump() << "\n";
  for (const auto& [key, value] : table.items())
    if (value.is_object()) WriteTable(out, header + "." + key, value);
}

void WriteToml(std::ostream& out, const Json& root) {
  for (const auto& [key, table] : root.items())
    if (table.is_object()) WriteTable(out, Json(key).dump(), table);
}

}  // namespace

std::vector<std::string> WriteRoss(BeamDefinition definition, const std::string& file,
                                   const std::vector<RossMagnet>& magnets) {
  for (const RossMagnet& m : magnets) definition.stations.push_back(m.z);
  const Json root = RotorTables(definition, magnets);
  std::ostringstream out;
  if (file.size() > 5 && file.substr(file.size() - 5) == ".json")
    out << root.dump(4) << "\n";
  else
    WriteToml(out, root);
  WriteFileAtomically(file, out.str());
  return UnknownToRoss(definition);
}

}  // namespace ambrig
