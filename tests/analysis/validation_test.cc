// Every published rig under examples/validation, and what a wrong file says.
#include "analysis/validation.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/errors.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

class Published : public ::testing::TestWithParam<const char*> {};

TEST_P(Published, FiguresAreMet) {
  const auto rows = Validate(std::string(AMBRIG_SOURCE_DIR "/examples/validation/") + GetParam() +
                             ".validation.toml");
  EXPECT_FALSE(rows.empty());
  for (const ValidationRow& r : rows) {
    if (r.low()) continue;  // said, not passed
    EXPECT_LE(r.tolerance, 0.005) << r.quantity;
    EXPECT_TRUE(r.agrees()) << r.name << ", " << r.quantity << ": " << r.difference;
  }
}

INSTANTIATE_TEST_SUITE_P(Rigs, Published,
                         ::testing::Values("friswell_5_9_1", "friswell_5_9_2", "friswell_5_9_5",
                                           "friswell_5_9_9", "friswell_unbalance", "rappid",
                                           "tum_mbtr", "ufu", "nelson_mcvaugh", "mse2011_rigid",
                                           "mbc500", "tu_darmstadt_magnet", "ufu_magnet"));

class ValidationFile : public CliFolder {
 protected:
  std::string Said(const std::string& text) const {
    Write("x.validation.toml", text);
    try {
      Validate((folder_ / "x.validation.toml").string());
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(ValidationFile, WrongOnesAreNamed) {
  const std::string rigid =
      "name = \"t\"\nsource = \"s\"\n[rotor]\nkind = \"rigid\"\nmass = 1.0\ninertia_transverse = "
      "1.0\ninertia_polar = 0.5\n";
  EXPECT_NE(Said(rigid).find("check: is missing"), std::string::npos) << Said(rigid);
  EXPECT_NE(Said(rigid + "[[check]]\nquantity = \"colour\"\npublished = [1.0]\n").find("quantity"),
            std::string::npos);
  EXPECT_NE(
      Said(rigid + "[[check]]\nquantity = \"mass\"\npublished = [1.0]\n").find("needs a beam"),
      std::string::npos);
  EXPECT_NE(
      Said(rigid +
           "[[check]]\nquantity = \"natural frequencies\"\nunit = \"Hz\"\npublished = [1.0]\n")
          .find("has 1 figure, to compare with: 0"),
      std::string::npos);
}

// A figure that is off fails its row and the command.
TEST_F(ValidationFile, ADifferenceIsFound) {
  const std::string text =
      ReadText(AMBRIG_SOURCE_DIR "/examples/validation/friswell_5_9_5.validation.toml");
  Write("x.validation.toml", Replaced(text, "137.06", "139.06"));
  EXPECT_EQ(Ambrig("validate x.validation.toml").exit, 1);
  Write("x.validation.toml", text);
  EXPECT_EQ(Ambrig("validate .").exit, 0);
}

}  // namespace
}  // namespace ambrig
