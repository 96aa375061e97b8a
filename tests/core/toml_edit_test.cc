/// TOML written again with some values changed: exactly these, and the same doubles elsewhere.
#include "core/base/toml_edit.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(c.String("file"), "/some/where/k.toml");
  EXPECT_EQ(c.Tables("filter")[0].Number("frequency"), 100.0);
  EXPECT_EQ(c.Tables("filter")[1].Number("frequency"), 5.0);
  EXPECT_EQ(t.Table("bearings")->Table("A")->Number("z"), -0.12);
  EXPECT_EQ(t.Table("bearings")->Table("A")->Rows("list")[1][0], 0.30000000000000004);
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
