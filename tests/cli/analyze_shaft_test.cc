// ambrig analyze of a shaft without magnetic bearings: what it writes, what it refuses.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

class AnalyzeShaft : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("shaft.toml", ReadText(AMBRIG_SOURCE_DIR "/examples/shaft/shaft.toml"));
  }
  void ExpectRefusedLine(const std::string& arguments, const std::string& said) {
    const Outcome o = Ambrig("analyze " + arguments);
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_THAT(o.text, HasSubstr(said));
  }
};

TEST_F(AnalyzeShaft, WritesEverythingThatItComputes) {
  const Outcome o = Ambrig(
      "analyze shaft.toml --speed 3000:4000 --max-speed 6000 --unbalance disk1:30 --unbalance "
      "disk2:50@90 --probe disk2 --probe pedestal --cross-coupling 0.6:2e6 --scatter 20 --json "
      "a.json --html a.html");
  ASSERT_LE(o.exit, 1) << o.text;
  const auto json = nlohmann::json::parse(ReadText(folder_ / "a.json"));
  EXPECT_EQ(o.exit, json.at("stable").get<bool>() ? 0 : 1);
  for (const char* key : {"campbell", "undamped_critical_speeds", "map", "unbalance", "axial",
                          "torsional", "free_bending"})
    EXPECT_FALSE(json.at(key).empty()) << key;
  EXPECT_EQ(json.at("unbalance")[0].at("probes").size(), 2U);
  const auto& scatter = json.at("scatter");
  EXPECT_EQ(scatter.at("rotors"), 20);
  ASSERT_EQ(scatter.at("unbalance").size(), 2U);  // a case, two probes
  ASSERT_FALSE(scatter.at("critical_speeds").empty());
  for (const auto& r : scatter.at("unbalance")) {
    ASSERT_EQ(r.at("amplitude_5_50_95").size(), scatter.at("speeds").size());
    for (const auto& band : r.at("amplitude_5_50_95")) EXPECT_LE(band[0], band[2]);
  }
  EXPECT_THAT(o.text, HasSubstr("95 % stay below"));
  EXPECT_TRUE(json.at("weight").at("held").get<bool>());
  double held = 0;  // the shaft stands on its two supports
  for (const auto& r : json.at("weight").at("reactions"))
    if (!r.at("z").is_null()) held += r.at("fy").get<double>();
  EXPECT_NEAR(held, json.at("weight").at("weight").get<double>(), 1e-6 * held);
  const std::string page = ReadText(folder_ / "a.html");
  for (const char* heading : {"Damped modes", "Critical speeds", "Unbalance", "Under its weight",
                              "Cross-coupled stiffness", "Scatter", "rotors that have it",
                              "nine of ten lie within the band"})
    EXPECT_THAT(page, HasSubstr(heading));
}

// --campbell is a part of the whole analysis: the same modes and damped critical speeds, nothing
// else.
TEST_F(AnalyzeShaft, CampbellAloneIsTheCampbellOfTheWhole) {
  const std::string speeds = "analyze shaft.toml --speed 3000:4000 --max-speed 6000 ";
  const Outcome whole = Ambrig(speeds + "--json whole.json");
  const Outcome alone = Ambrig(speeds + "--campbell --json alone.json --html alone.html");
  ASSERT_LE(whole.exit, 1) << whole.text;
  EXPECT_EQ(alone.exit, whole.exit) << alone.text;
  const auto all = nlohmann::json::parse(ReadText(folder_ / "whole.json"));
  const auto part = nlohmann::json::parse(ReadText(folder_ / "alone.json"));
  for (const char* key : {"campbell", "critical_speeds", "stable", "free_bending", "mass"})
    EXPECT_EQ(part.at(key), all.at(key)) << key;
  ASSERT_EQ(part.at("campbell").size(), 52U);  // 51 evenly spread and 4000; 3000 is one of them
  for (const char* key : {"undamped_critical_speeds", "map", "unbalance", "axial", "torsional"})
    EXPECT_TRUE(part.at(key).empty()) << key;
  for (const char* said : {"damped modes", "critical speeds"})
    EXPECT_THAT(alone.text, HasSubstr(said));
  for (const char* left : {"undamped", "under its weight", "unbalance"})
    EXPECT_THAT(alone.text, ::testing::Not(HasSubstr(left)));
  EXPECT_THAT(ReadText(folder_ / "alone.html"), HasSubstr("Damped modes"));
}

// The critical speed map moves the supports; a bearing between two shafts stays, so that at the
// supports' own stiffness the map has the critical speeds of the machine, and holds both shafts at
// every one.
TEST_F(AnalyzeShaft, TheMapKeepsWhatJoinsShafts) {
  std::string text = "[rotor]\nkind = \"beam\"\n";
  for (const char* name : {"inner", "outer"})
    text += std::string("[[rotor.shaft]]\nname = \"") + name + "\"\n";
  text +=
      "[[rotor.section]]\nshaft = \"inner\"\nlength = 2.5\nod = 0.05\nmaterial = \"steel\"\n"
      "[[rotor.section]]\nshaft = \"outer\"\nz0 = 0.5\nlength = 1.5\nod = 0.3\nid = 0.25\n"
      "material = \"steel\"\n";
  for (const char* at :
       {"shaft = \"inner\"\nz = 0.0", "shaft = \"inner\"\nz = 2.5", "shaft = \"outer\"\nz = 0.5",
        "shaft = \"inner\"\nz = 2.0\nto = \"outer\"\nto_z = 2.0"})
    text += std::string("[[rotor.support]]\n") + at + "\nk = 1e6\n";
  Write("two.toml", text);
  const Outcome o = Ambrig("analyze two.toml --speed 1000 --json two.json");
  ASSERT_LE(o.exit, 1) << o.text;
  const auto json = nlohmann::json::parse(ReadText(folder_ / "two.json"));
  const auto& map = json.at("map");
  ASSERT_EQ(map.size(), 41U);
  EXPECT_NEAR(map[20].at("stiffness").get<double>(), 1e6, 1);
  const auto& own = json.at("undamped_critical_speeds");
  ASSERT_EQ(map[20].at("speeds").size(), own.size());
  for (std::size_t k = 0; k < own.size(); ++k)
    EXPECT_NEAR(
        map[20].at("speeds")[k].at("speed").get<double>() / own[k].at("speed").get<double>(), 1,
        1e-7);
  for (const auto& row : map) EXPECT_FALSE(row.at("speeds").empty()) << row.at("stiffness");
}

// Ctrl-C in the middle of the eigenvalues of a large matrix, which look at nothing.
TEST_F(AnalyzeShaft, ObeysCtrlC) {
  Write("fine.toml", Replaced(ReadText(folder_ / "shaft.toml"), "elements_per_section = 4",
                              "elements_per_section = 150"));
  const Outcome o = Shell("cd " + folder_.string() + " && { env --default-signal=INT " +
                          std::string(AMBRIG_BINARY) +
                          " analyze fine.toml --speed 4000 --json a.json & sleep 2; kill -INT $!; "
                          "begin=$(date +%s); wait $!; code=$?; end=$(date +%s); test $((end - "
                          "begin)) -le 3 && exit $code; exit 99; }");
  EXPECT_EQ(o.exit, 130) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.json"));
}

TEST_F(AnalyzeShaft, MistakesAreOneLine) {
  Write("huge.toml", Replaced(ReadText(folder_ / "shaft.toml"), "elements_per_section = 4",
                              "elements_per_section = 1000"));
  ExpectRefusedLine("huge.toml --speed 4000", "more than 500 elements");
  ExpectRefusedLine("shaft.toml --probe wheel", "disk1");
  ExpectRefusedLine("shaft.toml --unbalance disk1", "PLANE:G_MM");
  ExpectRefusedLine("shaft.toml --unbalance pedestal:5", "housing");
  ExpectRefusedLine("shaft.toml --response A.x.load:A.x", "rig");
  ExpectRefusedLine("shaft.toml --grade 2.5 --unbalance disk1:5", "one of them");
  Write("rig.toml", ReferenceRigText());
  ExpectRefusedLine("rig.toml --grade 2.5", "without magnetic bearings");
  Write("plain.toml", Replaced(ReadText(folder_ / "shaft.toml"),
                               "k = { value = 3.0e7, sd = 1.5e6 }", "k = 3.0e7"));
  ExpectRefusedLine("plain.toml --scatter 10", "sd");
}

}  // namespace
}  // namespace ambrig
