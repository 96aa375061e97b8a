// Files that releases of ROSS saved themselves (tests/rotor/ross_files): read, and there and back.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "rotor/shaft/convert_shaft.h"
#include "rotor/shaft/ross_elements.h"
#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/ross_magnets.h"
#include "rotor/shaft/rotor_modes.h"
#include "tests/rotor/shaft/shaft_tables.h"

namespace ambrig {
namespace {

const std::string kRossFiles = std::string(AMBRIG_SOURCE_DIR) + "/tests/rotor/ross_files/";

std::vector<std::string> SavedByRoss(const std::string& part) {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(kRossFiles))
    if (const std::string name = entry.path().filename().string();
        name.find(part) != std::string::npos && !name.ends_with(".md"))
      out.push_back(name);
  std::sort(out.begin(), out.end());
  return out;
}

struct RoundTripFiles {
  RoundTripFiles()
      : ours((std::filesystem::path(::testing::TempDir()) /
              ("ross_round_trip_" + std::to_string(::getpid()) + ".toml"))
                 .string()),
        back(ours + ".json") {}
  ~RoundTripFiles() {
    std::filesystem::remove(ours);
    std::filesystem::remove(back);
  }
  std::string ours, back;
};

// wn = 91.79655318, 96.28899977 rad/s, as ROSS's documentation prints for it.
TEST(RossReleases, TheExampleOfEveryReleaseSinceOne) {
  std::set<std::string> releases;
  for (const std::string& name : SavedByRoss("_rotor_example.")) {
    const RossRotor r = ReadRoss(kRossFiles + name);
    EXPECT_TRUE(r.ignored.empty()) << name;
    const auto modes = WhirlModes(Assemble(BuildBeam(r.definition)), 0, 2);
    EXPECT_NEAR(modes[0].omega_n, 91.79655318, 5e-8) << name;
    EXPECT_NEAR(modes[1].omega_n, 96.28899977, 5e-8) << name;
    releases.insert(name.substr(0, name.find('_')));
  }
  EXPECT_EQ(releases,
            (std::set<std::string>{"v1.0.1", "v1.1.0", "v1.2.0", "v1.3.0", "v1.4.2", "v1.5.4",
                                   "v1.6.1", "v2.0.0", "v2.1.0", "v2.2.0", "v2.3.0"}));
}

/// Elements by kind, node and, where several stand there, order; 6DoF classes of releases before
/// 1.5 as the others.
std::multimap<std::string, RossElement> ByPlace(const std::string& file) {
  std::multimap<std::string, RossElement> out;
  for (const RossElement& e : ReadRossElements(file)) {
    if (!e.Has("n")) continue;
    std::string kind = e.kind.substr(0, e.kind.find("6DoF"));
    if (IsRossMagneticBearing(e)) kind = "Magnet";
    out.emplace(kind + std::to_string(e.Node()), e);
  }
  return out;
}

/// What both know is equal; a table of one repeated value is that value.
void ExpectSameNumbers(const RossElement& a, const RossElement& b, const std::string& what) {
  const bool magnet = IsRossMagneticBearing(a);
  for (const auto& [key, values] : a.numbers) {
    // a magnet's coefficients follow from its gains; its poles stand at pi/8 here
    if (!b.Has(key) || (magnet && (key.size() == 3 || key == "alpha"))) continue;
    const std::vector<double>& other = b.numbers.at(key);
    for (std::size_t k = 0; k < std::max(values.size(), other.size()); ++k) {
      const double mine = values[std::min(k, values.size() - 1)],
                   theirs = other[std::min(k, other.size() - 1)];
      EXPECT_NEAR(mine, theirs, 1e-12 * std::abs(mine)) << what << " " << key;
    }
  }
  for (const auto& [key, value] : a.material)
    if (b.material.count(key)) {
      EXPECT_NEAR(value, b.material.at(key), 1e-12 * std::abs(value)) << what << " " << key;
    }
}

TEST(RossReleases, ThereAndBackEveryFieldIsEqual) {
  const RoundTripFiles files;
  const auto names = SavedByRoss("example");
  ASSERT_GE(names.size(), 20U);
  for (const std::string& name : names) {
    ConvertShaft(kRossFiles + name, files.ours);
    ConvertShaft(files.ours, files.back);
    const auto before = ByPlace(kRossFiles + name), after = ByPlace(files.back);
    ASSERT_EQ(before.size(), after.size()) << name;
    for (auto a = before.begin(), b = after.begin(); a != before.end(); ++a, ++b) {
      ASSERT_EQ(a->first, b->first) << name;
      ExpectSameNumbers(a->second, b->second, name + " " + a->first);
    }
  }
}

TEST(RossReleases, SavedMagneticBearingsAreBearingsOfARig) {
  const RoundTripFiles files;
  for (const std::string& name : SavedByRoss("rotor_amb")) {
    const ShaftConversion c = ConvertShaft(kRossFiles + name, files.ours);
    EXPECT_EQ(c.magnetic_bearings, 2U) << name;
    const RossRotor r = ReadRoss(kRossFiles + name);
    EXPECT_TRUE(r.definition.supports.empty()) << name;
    const ShaftConversion back = ConvertShaft(files.ours, files.back);
    EXPECT_EQ(back.magnetic_bearings, 2U) << name;
    EXPECT_EQ(back.not_carried.size(), 1U) << "amplifiers and the like are named";
  }
}

// A magnet of 0.3 A: what is assumed of its amplifier follows from the bias.
TEST(RossMagnets, TheAmplifierOfAWeakMagnetIsAWeakOne) {
  RossMagnet m;
  m.name = "weak";
  m.z = 0.1;
  m.gap = 5e-4;
  m.area = 1e-4;
  m.turns = 200;
  m.bias = 0.3;
  const std::string text = MagneticRigText(testing::ParseShaft(testing::kShaftTables), {m});
  for (const char* line : {"\ni_max = 0.6 ", "\nadc_range = 0.9\n", "\ncurrent_noise = 0.0006\n",
                           "\nbias_current = 0.3\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

// Of a rig's bearings ROSS can say those of eight poles NSNSNSNS with a bias; the others are named.
TEST(RossMagnets, BearingsOfAnotherKindOrWithoutABiasStayBehind) {
  const RoundTripFiles files;
  const std::string size = "z = 0.1\nturns = 50\npole_area = 2e-4\ngap = 4e-4\n";
  std::ofstream(files.ours) << "[controller]\nbias_current = 2.0\nkp = 4e5\n[bearings.A]\n" + size +
                                   "[bearings.paired]\nwinding = \"NNSSNNSS\"\n" + size +
                                   "[bearings.thrust]\nkind = \"thrust\"\n" + size +
                                   "[bearings.unbiased]\ncontroller = { bias_current = 0.0 }\n" +
                                   size;
  std::vector<std::string> lost;
  const std::vector<RossMagnet> magnets = MagnetsOfRig(files.ours, lost);
  ASSERT_EQ(magnets.size(), 1U);
  EXPECT_EQ(magnets[0].name, "A");
  EXPECT_EQ(magnets[0].turns, 100);
  EXPECT_EQ(magnets[0].bias, 2);
  EXPECT_NEAR(magnets[0].kp * magnets[0].current_gain(), 4e5, 1e-6);
  ASSERT_EQ(lost.size(), 4U);
  for (const char* name : {"bearings.paired", "bearings.thrust", "bearings.unbiased"})
    EXPECT_EQ(std::count_if(lost.begin(), lost.end(),
                            [&](const std::string& l) { return l.starts_with(name); }),
              1)
        << name;
}

TEST(RossReleases, WhatIsNoRotorIsRefusedByName) {
  const RoundTripFiles files;
  for (const char* text :
       {"{}", "[]", "# ROSS\n[parameters]\n", "{\"BearingElement_a\": {\"n\": 0, \"kxx\": 1}}"}) {
    std::ofstream(files.back) << text;
    try {
      ReadRoss(files.back);
      FAIL() << text;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(files.back), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace ambrig
