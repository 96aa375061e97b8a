// A case with another rig keeps its text; in another folder its names lead to the same files.
#include "discovery/case/case_file.h"

#include <gmock/gmock.h>

namespace ambrig {
namespace {

const std::string kCase =
    "# a comment\nrig = \"rig.toml\"  # the rig\n\n[[record]]  # first\nscenario = "
    "\"s.toml\"\ndata = \"one.h5\"\n"
    "\n[[record]]\nkind = \"frf\"\ndata = \"/abs/two.csv\"\n";

TEST(CaseFile, AnotherRigInTheSameFolder) {
  std::string wanted = kCase;
  wanted.replace(wanted.find("rig.toml"), 8, "rig_2.toml");
  EXPECT_EQ(CaseWithRig(kCase, "p/case.toml", "p/rig_2.toml", "p/case_2.toml"), wanted);
}

TEST(CaseFile, InAnotherFolderNamesLeadToTheSameFiles) {
  const std::string text = CaseWithRig(kCase, "p/case.toml", "q/rig_2.toml", "q/case.toml");
  EXPECT_THAT(text, ::testing::HasSubstr("rig = \"rig_2.toml\"  # the rig"));
  EXPECT_THAT(text, ::testing::HasSubstr("scenario = \"../p/s.toml\"\ndata = \"../p/one.h5\""));
  EXPECT_THAT(text, ::testing::HasSubstr("data = \"/abs/two.csv\""));
  EXPECT_THAT(text, ::testing::HasSubstr("# a comment"));
}

}  // namespace
}  // namespace ambrig
