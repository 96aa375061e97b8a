// ROSS's rotor file as its versions 1, 2 and 3 save it: the same rotor in each of them, with the
// frequencies that ROSS's own documentation prints; and what we write against what its loaders
// take. Facts of the format from petrobras/ross: ross/rotor_assembly.py (`Rotor.load` of version 1,
// file 1319151207, and of 3, commit 0d49af8), docs/user_guide/rotor2.toml, ross/tests/data/v2.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {
namespace {

using Json = nlohmann::ordered_json;

struct Temporary {
  explicit Temporary(const std::string& ending)
      : path((std::filesystem::temp_directory_path() /
              ("ross_version_" + std::to_string(getpid()) + ending))
                 .string()) {}
  ~Temporary() { std::filesystem::remove(path); }
  std::string path;
};

enum class Saved { kFirst, kOne, kTwo, kThree };

/// ROSS's rotor_example: 1.5 m of 50 mm steel in six elements, two disks of 280 mm, 1 and 0.8 MN/m.
Json RotorExample(Saved version) {
  Json root = Json::object();
  if (version >= Saved::kTwo) root["ross_version"] = version == Saved::kTwo ? "2.3.0" : "3.0.0";
  root["parameters"] = Json::object();
  if (version == Saved::kThree)
    root["parameters"] = {{"default_damping_ratio", 0.0}, {"alpha", 0.0}, {"beta", 0.0}};
  for (int n = 0; n < 6; ++n) {
    const std::string tag = "Shaft Element " + std::to_string(n);
    Json& e = root["ShaftElement_" + tag];
    e = {{"L", 0.25},
         {"idl", 0.0},
         {"odl", 0.05},
         {"idr", 0.0},
         {"odr", 0.05},
         {"n", n},
         {"axial_force", 0},
         {"torque", 0},
         {"shear_effects", true},
         {"rotary_inertia", true},
         {"gyroscopic", true},
         {"shear_method_calc", "cowper"},
         {"tag", tag}};
    if (version >= Saved::kOne) e["alpha"] = e["beta"] = 0.0;
    e["material"] = {
        {"name", "Steel"}, {"rho", 7810.0}, {"E", 2.11e11}, {"G_s", 8.12e10}, {"color", "#525252"}};
  }
  for (int n : {2, 4}) {
    const std::string tag = "Disk " + std::to_string(n / 2 - 1);
    root["DiskElement_" + tag] = {{"n", n},
                                  {"m", 32.58972765304033},
                                  {"Id", 0.17808928257067666},
                                  {"Ip", 0.32956362089137037},
                                  {"tag", tag}};
    if (version >= Saved::kOne)
      root["DiskElement_" + tag].update({{"scale_factor", 1.0}, {"color", "Firebrick"}});
  }
  for (int n : {0, 6}) {
    const std::string tag = "Bearing " + std::to_string(n / 6);
    Json& e = root["BearingElement_" + tag];
    e = {{"n", n}, {"tag", tag}, {"color", "#355d7a"}, {"scale_factor", 1}};
    const bool table = version == Saved::kThree && n == 6;  // over the speed, twice the same
    const auto set = [&](const char* key, double value) {
      e[key] = table ? Json{value, value} : Json::array({value});
    };
    set("kxx", 1e6), set("kyy", 8e5), set("kxy", 0), set("kyx", 0), set("cxx", 0), set("cyy", 0),
        set("cxy", 0), set("cyx", 0);
    if (version >= Saved::kOne)
      for (const char* key : {"mxx", "myy", "mxy", "myx"}) set(key, 0);
    if (version >= Saved::kTwo)
      for (const char* key : {"kzz", "czz", "mzz"}) set(key, 0);
    if (version == Saved::kThree) e["interpolation"] = "pchip";
    if (table) e["speed"] = {0.0, 500.0};
  }
  return root;
}

/// As toml.dump writes it: the nested material after its element.
std::string Toml(const Json& root) {
  std::string text =
      root.contains("ross_version")
          ? "# This file is saved by ROSS.\n\nross_version = " + root["ross_version"].dump() +
                "\n\n"
          : "";
  for (const auto& [name, table] : root.items()) {
    if (!table.is_object()) continue;
    text += "[" + Json(name).dump() + "]\n";
    std::string nested;
    for (const auto& [key, value] : table.items()) {
      if (!value.is_object()) {
        text += key + " = " + value.dump() + "\n";
        continue;
      }
      nested += "\n[" + Json(name).dump() + "." + key + "]\n";
      for (const auto& [k, v] : value.items()) nested += k + " = " + v.dump() + "\n";
    }
    text += nested + "\n";
  }
  return text;
}

/// As json.dump writes it: None is null.
std::string SavedJson(Json root) {
  Json noted = {{"_note", "This file is saved by ROSS."}};
  noted.update(root);
  for (const char* key : {"min_w", "max_w", "rated_w", "modal_damping_ratio"})
    noted["parameters"][key] = nullptr;
  for (auto& [name, table] : noted.items())
    if (name.rfind("BearingElement", 0) == 0)
      for (const char* key : {"frequency", "n_link"}) table[key] = nullptr;
  return noted.dump(2);
}

RossRotor ReadText(const std::string& ending, const std::string& text) {
  const Temporary file(ending);
  std::ofstream(file.path) << text;
  return ReadRoss(file.path);
}

/// Printed for rotor_example at rest: wn = 91.79655318, 96.28899977 rad/s (Rotor.run_modal).
void ExpectTheExample(const RossRotor& r, const std::string& what) {
  EXPECT_TRUE(r.ignored.empty()) << what;
  const auto modes = WhirlModes(Assemble(BuildBeam(r.definition)), 0, 2);
  EXPECT_NEAR(modes[0].omega_n, 91.79655318, 5e-8) << what;
  EXPECT_NEAR(modes[1].omega_n, 96.28899977, 5e-8) << what;
}

TEST(RossVersions, OneRotorInAllOfThem) {
  for (const Saved version : {Saved::kFirst, Saved::kOne, Saved::kTwo, Saved::kThree})
    ExpectTheExample(ReadText(".toml", Toml(RotorExample(version))),
                     "toml " + std::to_string(static_cast<int>(version)));
  for (const Saved version : {Saved::kTwo, Saved::kThree})
    ExpectTheExample(ReadText(".json", SavedJson(RotorExample(version))),
                     "json " + std::to_string(static_cast<int>(version)));
}

// Rotor's own example: two elements, one disk, 1 MN/m: wd[0] = 215.3707... rad/s.
TEST(RossVersions, TheExampleOfTheRotorClass) {
  Json root = RotorExample(Saved::kTwo);
  for (int n = 2; n < 6; ++n) root.erase("ShaftElement_Shaft Element " + std::to_string(n));
  root.erase("DiskElement_Disk 1");
  root["DiskElement_Disk 0"]["n"] = 1;
  root["BearingElement_Bearing 1"]["n"] = 2;
  for (const char* tag : {"BearingElement_Bearing 0", "BearingElement_Bearing 1"})
    root[tag]["kyy"] = {1e6};
  const RossRotor r = ReadText(".json", root.dump());
  EXPECT_NEAR(WhirlModes(Assemble(BuildBeam(r.definition)), 0, 1)[0].omega_d, 215.3707, 1e-4);
}

// from_section's example: three elements of 0.5 m, full disks of 280 and 350 mm, 1 MN/m; printed to
// 4 digits (650.1377 among them is torsion).
TEST(RossVersions, TheExampleOfFromSection) {
  Json root = RotorExample(Saved::kOne);
  for (int n = 0; n < 6; ++n) {
    const std::string name = "ShaftElement_Shaft Element " + std::to_string(n);
    n < 3 ? void(root[name]["L"] = 0.5) : void(root.erase(name));
  }
  const double od[] = {0.28, 0.35};
  for (int k = 0; k < 2; ++k) {
    const Disk d = DiskFromGeometry(0, 0.07, 0, od[k], 7810);
    root["DiskElement_Disk " + std::to_string(k)].update(
        {{"n", k + 1}, {"m", d.mass}, {"Id", d.inertia_diametral}, {"Ip", d.inertia_polar}});
  }
  root["BearingElement_Bearing 1"]["n"] = 3;
  for (const char* tag : {"BearingElement_Bearing 0", "BearingElement_Bearing 1"})
    root[tag]["kyy"] = {1e6};
  const auto modes =
      WhirlModes(Assemble(BuildBeam(ReadText(".toml", Toml(root)).definition)), 0, 5);
  const double printed[] = {85.7634, 85.7634, 271.9326, 271.9326, 718.58};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(modes[k].omega_n, printed[k], 6e-5) << k;
}

// What version 3 can say and a shaft here cannot is named.
TEST(RossVersions, WhatIsNotCarriedIsNamed) {
  Json root = RotorExample(Saved::kThree);
  root["parameters"]["alpha"] = 0.5;
  root["parameters"]["modal_damping_ratio"] = {0.01, 0.02};
  Json& bearing = root["BearingElement_Bearing 0"];
  for (auto& [key, value] : bearing.items())
    if (value.is_array()) value = Json::array({Json::array({1.0, 2.0}), Json::array({1.0, 2.0})});
  bearing["speed"] = bearing["frequency"] = {0.0, 500.0};
  const std::set<std::string> expected = {
      "parameters.alpha = 0.5", "parameters.modal_damping_ratio = 0.01",
      "BearingElement_Bearing 0 (coefficients over speed and whirl frequency)"};
  for (const char* ending : {".toml", ".json"}) {
    const RossRotor r = ReadText(ending, ending == std::string(".toml") ? Toml(root) : root.dump());
    EXPECT_EQ(std::set<std::string>(r.ignored.begin(), r.ignored.end()), expected) << ending;
    EXPECT_EQ(r.definition.supports.size(), 1u);
  }
}

/// A loader calls the class with the table's keys: all it demands, none it does not know (version
/// 1's, the narrowest).
void ExpectTaken(const Json& table, const std::set<std::string>& demanded,
                 std::set<std::string> known) {
  known.insert(demanded.begin(), demanded.end());
  std::set<std::string> keys;
  for (const auto& [key, value] : table.items()) keys.insert(key);
  for (const std::string& key : demanded) EXPECT_TRUE(keys.count(key)) << key;
  for (const std::string& key : keys) EXPECT_TRUE(known.count(key)) << key;
}

TEST(RossVersions, EveryLoaderTakesWhatIsWritten) {
  BeamDefinition d = ReadText(".json", RotorExample(Saved::kTwo).dump()).definition;
  d.supports[0].name = d.disks[0].name = d.disks[1].name = "one name";
  const Temporary file(".json");
  WriteRoss(d, file.path);
  const Json root = Json::parse(std::ifstream(file.path));
  EXPECT_TRUE(root.at("parameters").is_object());
  std::set<std::string> tags;
  for (const auto& [name, table] : root.items()) {
    ASSERT_TRUE(table.is_object())
        << name << ": version 1 takes every entry of the file for an element";
    if (name == "parameters") continue;
    EXPECT_TRUE(tags.insert(table.at("tag")).second)
        << "tags are unique over all elements: " << table.at("tag");
    EXPECT_EQ(name.substr(name.find('_') + 1), table.at("tag"));
    const std::string kind = name.substr(0, name.find('_'));
    if (kind == "ShaftElement") {
      ExpectTaken(table, {"L", "idl", "odl", "material"},
                  {"idr", "odr", "n", "axial_force", "torque", "shear_effects", "rotary_inertia",
                   "gyroscopic", "shear_method_calc", "tag"});
      ExpectTaken(table.at("material"), {"name", "rho", "E", "G_s"}, {"color"});
      EXPECT_EQ(table.at("material").at("name").get<std::string>().find(' '), std::string::npos)
          << "ROSS refuses blanks";
    } else if (kind == "DiskElement") {
      ExpectTaken(table, {"n", "m", "Id", "Ip"}, {"tag"});
    } else {
      EXPECT_EQ(kind, "BearingElement");
      ExpectTaken(table, {"n", "kxx", "cxx"}, {"kyy", "kxy", "kyx", "cyy", "cxy", "cyx", "tag"});
    }
  }
  EXPECT_EQ(tags.size(), 10u);
  // A damped shaft needs the keys of later files.
  d.sections[0].damping_stiffness = 1e-6;
  WriteRoss(d, file.path);
  const Json damped = Json::parse(std::ifstream(file.path));
  EXPECT_EQ(damped.at("ShaftElement_Shaft Element 0").at("beta"), 1e-6);
  EXPECT_FALSE(damped.at("ShaftElement_Shaft Element 1").contains("beta"));
}

}  // namespace
}  // namespace ambrig
