/// TOML written again with some values changed: exactly these, and the same doubles elsewhere.
#include "core/base/toml_edit.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/errors.h"
#include "core/base/toml.h"

namespace ambrig {
namespace {

const std::string kText =
    "name = \"a\\\\b \\\"q\\\"\"\n[controller]\nkp = 0.1\nki = { value = 3, sd = 0.25 }\nn = "
    "7\nfile = \"k.toml\"\n"
    "[[controller.filter]]\nfrequency = 100.0\n[[controller.filter]]\nfrequency = "
    "1e-7\n[bearings.A]\nlist = [[1.0, 2.0], [0.30000000000000004, 4.0]]\nspeeds = [0.0, 3]\n";

TEST(TomlEdit, ChangesWhatWasAskedFor) {
  const double kp = 0.1 + 0.2, third = 1.0 / 3;
  const std::string out = EditedToml(kText, "/some/where/rig.toml",
                                     {{"controller.kp", kp},
                                      {"controller.ki", third},
                                      {"controller.filter[1].frequency", 5.0},
                                      {"bearings.A.z", -0.12},
                                      {"name", std::string("new")}});
  const TomlTable t = TomlTable::FromText(out, "out.toml");
  const TomlTable c = *t.Table("controller");
  EXPECT_EQ(t.String("name"), "new");
  EXPECT_EQ(c.Number("kp"), kp);
  double sd = 0;
  EXPECT_EQ(c.Number("ki", 0, &sd), third);
  EXPECT_EQ(sd, 0.25);
  EXPECT_EQ(c.Integer("n", 0), 7);
  EXPECT_EQ(c.String("file"), "k.toml");
  EXPECT_EQ(c.Tables("filter")[0].Number("frequency"), 100.0);
  EXPECT_EQ(c.Tables("filter")[1].Number("frequency"), 5.0);
  EXPECT_EQ(t.Table("bearings")->Table("A")->Number("z"), -0.12);
  EXPECT_EQ(t.Table("bearings")->Table("A")->Rows("list")[1][0], 0.30000000000000004);
}

TEST(TomlEdit, FilesBesideTheTextBecomeAbsolute) {
  const std::string out = WithAbsoluteFiles(kText, "/some/where/rig.toml");
  EXPECT_EQ(TomlTable::FromText(out, "f").Table("controller")->String("file"),
            "/some/where/k.toml");
  EXPECT_EQ(WithAbsoluteFiles(out, "/else/rig.toml"), out);
}

// A person's file: comments, order, indentation, signs of more than one byte and Windows' line
// ends.
const std::string kWritten =
    "# Prüfstand  \xe2\x9c\x93 of the laboratory\n"
    "\n"
    "name = 'Ünï'   # bare\n"
    "[rotor]  # after the name\n"
    "  mass = { value = 4.20, sd = 0.1 } # weighed \xc2\xb1\n"
    "  inertia = 3.60e-2\r\n"
    "speeds = [ 1.0, # first\n"
    "           2.50 ]\n"
    "\n"
    "# the sensor side\n"
    "[bearings.A]\n"
    "sensor.gain = 1.0\n"
    "\n"
    "[[effect]] # one\n"
    "name = \"unbalance\"\n"
    "parameters = { g = 1.0 }\n"
    "# of the second\n"
    "[[effect]]\n"
    "name = \"bow\"\n"
    "[effect.parameters]\n"
    "size = 2.0 # m\n"
    "\n"
    "# the end\n"
    "[amplifier]\n"
    "voltage = 30";

std::string Expected(const std::string& from, const std::string& to) {
  std::string text = kWritten;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(TomlEdit, ChangesNothingElseInTheText) {
  const struct {
    TomlEdit edit;
    std::string from, to;
  } kinds[] = {
      {{"rotor.inertia", 0.5}, "3.60e-2", "0.5"},
      {{"rotor.mass", 4.5}, "4.20", "4.5"},
      {{"rotor.mass.fitted", 4.5}, "sd = 0.1 }", "sd = 0.1, fitted = 4.5 }"},
      {{"rotor.mass", TomlLiteral{"{ value = 1.0 }"}},
       "{ value = 4.20, sd = 0.1 }",
       "{ value = 1.0 }"},
      {{"rotor.speeds[1]", 3.0}, "2.50", "3.0"},
      {{"rotor.friction", 0.1}, "2.50 ]\n", "2.50 ]\nfriction = 0.1\n"},
      {{"name", std::string("a \"b\"")}, "'Ünï'", "\"a \\\"b\\\"\""},
      {{"gap", 1.0}, "# bare\n", "# bare\ngap = 1.0\n"},
      {{"bearings.A.sensor.gain", 2.0}, "gain = 1.0", "gain = 2.0"},
      {{"bearings.A.sensor.noise", 2.0}, "gain = 1.0\n", "gain = 1.0\nsensor.noise = 2.0\n"},
      {{"bearings.A.z", -0.1}, "gain = 1.0\n", "gain = 1.0\nz = -0.1\n"},
      {{"effect[0].parameters.g", 7.0}, "g = 1.0", "g = 7.0"},
      {{"effect[1].parameters.size", 7.0}, "size = 2.0", "size = 7.0"},
      {{"effect[1].parameters.phase", 7.0}, "# m\n", "# m\nphase = 7.0\n"},
      {{"amplifier.rate", 5.0}, "voltage = 30", "voltage = 30\nrate = 5.0\n"},
      {{"bearings.gap", 1.0}, "voltage = 30", "voltage = 30\n[bearings]\ngap = 1.0\n"},
  };
  for (const auto& k : kinds) {
    const std::string out = EditedToml(kWritten, "f", {k.edit});
    EXPECT_EQ(out, Expected(k.from, k.to)) << k.edit.path;
    EXPECT_TRUE(HasTomlPath(out, "f", k.edit.path)) << k.edit.path;
  }
}

TEST(TomlEdit, AKeyBeforeTheFirstTable) {
  EXPECT_EQ(EditedToml("[a]\nb = 1", "f", {{"c", 2.0}}), "c = 2.0\n[a]\nb = 1");
  EXPECT_EQ(EditedToml("# file\n\n[a]", "f", {{"c", 2.0}}), "# file\nc = 2.0\n\n[a]");
  EXPECT_EQ(EditedToml("# of a\n[a]", "f", {{"a.c", 2.0}}), "# of a\n[a]\nc = 2.0\n");
  EXPECT_EQ(EditedToml("a = {}", "f", {{"a.c", 2.0}}), "a = { c = 2.0 }");
}

TEST(TomlEdit, TakesOutATable) {
  EXPECT_EQ(WithoutTomlTable(kWritten, "f", "effect[0]"),
            Expected("[[effect]] # one\nname = \"unbalance\"\nparameters = { g = 1.0 }\n", ""));
  EXPECT_EQ(WithoutTomlTable(kWritten, "f", "effect[1]"),
            Expected("[[effect]]\nname = \"bow\"\n[effect.parameters]\nsize = 2.0 # m\n", ""));
  EXPECT_THROW(WithoutTomlTable(kWritten, "f", "effect[2]"), InputError);
  EXPECT_THROW(WithoutTomlTable(kWritten, "f", "rotor.mass"), InputError);
}

TEST(TomlEdit, NumbersReadBack) {
  for (const double v : {0.1 + 0.2, 1.0, -0.0, 1e300, 5e-324, 1.0 / 3, 123456789.0})
    EXPECT_EQ(TomlNumberAt("a = " + TomlNumber(v), "f", "a"), v) << v;
  EXPECT_EQ(TomlNumber(2), "2.0");
  EXPECT_EQ(TomlNumber(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(TomlEdit, LeavesTheRest) {
  const TomlTable t = TomlTable::FromText(EditedToml(kText, "/x/rig.toml", {}), "out.toml");
  EXPECT_EQ(t.String("name"), "a\\b \"q\"");
  EXPECT_EQ(t.Table("controller")->Tables("filter")[1].Number("frequency"), 1e-7);
}

TEST(TomlEdit, ElementsOfAList) {
  const TomlTable t = TomlTable::FromText(
      EditedToml(kText, "/x/rig.toml", {{"bearings.A.speeds[1]", 0.5}}), "out.toml");
  EXPECT_EQ(t.Table("bearings")->Table("A")->Numbers("speeds"), (std::vector<double>{0, 0.5}));
  EXPECT_EQ(TomlNumberAt(kText, "f", "bearings.A.speeds[1]"), 3);
}

TEST(TomlEdit, ReadsANumber) {
  EXPECT_EQ(TomlNumberAt(kText, "f", "controller.ki"), 3);
  EXPECT_EQ(TomlNumberAt(kText, "f", "controller.filter[1].frequency"), 1e-7);
}

TEST(TomlEdit, TellsWrongPaths) {
  for (const char* path :
       {"", "controller.nothing.kp", "controller.filter[2].frequency",
        "controller.filter[x].frequency", "controller.file", "controller", "bearings.A.list",
        "bearings.A.list[0]", "bearings.A.speeds[2]", "controller.filter[1]", "controller..kp"})
    EXPECT_THROW(EditedToml(kText, "f", {{path, 1.0}}), InputError) << path;
  EXPECT_THROW(TomlNumberAt(kText, "f", "controller.kz"), InputError);
  EXPECT_THROW(EditedToml("a = = 3", "f", {}), InputError);
}

}  // namespace
}  // namespace ambrig
