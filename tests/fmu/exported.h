#pragma once
/// An FMU of the reference rig, as `ambrig export` writes it.
#include "core/base/toml_edit.h"
#include "tests/campaign/campaign_folder.h"
#include "tests/fmu/importer.h"

namespace ambrig::testing {

struct Exported {
  /// `scenario`: the text of one, or empty.
  explicit Exported(const std::string& fmi, const std::string& scenario = "") {
    std::string command = " export rig.toml --fmu rig.fmu --fmi " + fmi;
    if (!scenario.empty()) {
      folder.Write("s.toml", scenario);
      command += " --scenario s.toml";
    }
    made = folder.In(AMBRIG_BINARY + command);
    EXPECT_EQ(made.exit, 0) << made.text;
  }
  CampaignFolder folder;
  std::string fmu = folder.File("rig.fmu"), rig = folder.File("rig.toml");
  Outcome made;
};

}  // namespace ambrig::testing
