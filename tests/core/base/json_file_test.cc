// JSON of others: damaged, without end, and with names that are no UTF-8.
#include "core/base/json_file.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

class JsonFile : public ::testing::Test {
 protected:
  std::string RefusalOf(const std::string& text) const {
    testing::WriteBytes(file_, text);
    return testing::ErrorText<InputError>([&] { ReadJson(file_); });
  }
  static std::string Nested(std::size_t n) {
    return R"({"events": )" + std::string(n, '[') + std::string(n, ']') + "}";
  }
  testing::TemporaryFolder folder_;
  std::string file_ = folder_.File("a.json");
};

TEST_F(JsonFile, DamageIsToldWithItsPlace) {
  EXPECT_EQ(RefusalOf("{\n \"a\": ?}"), file_ + ":2:7: not valid JSON");
  EXPECT_EQ(RefusalOf("{"), file_ + ":1:2: not valid JSON: it ends too early");
  EXPECT_EQ(RefusalOf("[1e999]"), file_ + ": holds a number beyond the range of a double");
}

// A copy of such a value takes the stack of the program.
TEST_F(JsonFile, ValuesDeepInsideOneAnotherAreRefused) {
  EXPECT_EQ(RefusalOf(Nested(200000)), file_ + ": values more than 100 deep inside one another");
  EXPECT_EQ(RefusalOf(Nested(101)), file_ + ": values more than 100 deep inside one another");
  EXPECT_EQ(RefusalOf(Nested(90)), "");
}

TEST(JsonText, BytesThatAreNoUtf8BecomeAMark) {
  EXPECT_EQ(JsonText(nlohmann::json{{"file", "a\xff.csv"}}), "{\"file\":\"a\ufffd.csv\"}");
  EXPECT_EQ(JsonText(nlohmann::ordered_json{{"b", 1}, {"a", 2}}, 1), "{\n \"b\": 1,\n \"a\": 2\n}");
}

}  // namespace
}  // namespace ambrig
