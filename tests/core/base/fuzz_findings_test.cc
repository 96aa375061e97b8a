/// Damaged files that a fuzz target once found (tests/fuzz/findings/TARGET), read again by the
/// reader of that target.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "core/base/errors.h"
#include "core/base/toml.h"
#include "core/record/read_record.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

const std::filesystem::path kFindings = AMBRIG_SOURCE_DIR "/tests/fuzz/findings";
const std::map<std::string, std::string> kExtensions = {{"csv", ".csv"},
                                                        {"hdf5", ".h5"},
                                                        {"labview_text", ".lvm"},
                                                        {"mat", ".mat"},
                                                        {"universal_file", ".uff"},
                                                        {"tdms", ".tdms"}};

TEST(FuzzFindings, RecordsAreTakenOrRefusedInOneLine) {
  const testing::TemporaryFolder folder;
  int read = 0;
  for (const auto& [target, extension] : kExtensions) {
    if (!std::filesystem::exists(kFindings / target)) continue;
    for (const auto& finding : std::filesystem::directory_iterator(kFindings / target)) {
      SCOPED_TRACE(finding.path().string());
      const std::string file = folder.File("input" + extension);
      std::filesystem::copy_file(finding.path(), file,
                                 std::filesystem::copy_options::overwrite_existing);
      ++read;
      try {
        const Record record = ReadMeasurement(file).record;
        EXPECT_LE(record.notes.size(), 1U << 16);
        for (const Channel& c : record.channels)
          EXPECT_LT(c.name.size() + c.unit.size(), 1U << 17);  // no gigabytes of text
      } catch (const InputError& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      }
    }
  }
  EXPECT_GE(read, 2);
}

TEST(FuzzFindings, ALineEndInsideAMessageIsASpace) {
  const std::string text =
      testing::ErrorText<InputError>([] { TomlTable::FromText("a = f\n", "rig.toml"); });
  EXPECT_NE(text.find("rig.toml:1: not valid TOML"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  const TomlTable t = TomlTable::FromText("\"a\\nb\\u0000\\u007f\" = \"c\\nd\"\n", "rig.toml");
  EXPECT_EQ(testing::ErrorText<InputError>([&] { t.RejectUnknownKeys(); }),
            "rig.toml:1: a b  : unknown key, allowed: ");
  EXPECT_EQ(testing::ErrorText<InputError>([&] { t.Number("a\nb"); }),
            "rig.toml:1: a b: is missing, allowed: a number");
}

}  // namespace
}  // namespace ambrig
