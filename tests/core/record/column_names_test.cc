// Columns by the name that a person sees in MATLAB, in an HDF5 viewer or in the head of a CSV file.
#include "core/record/column_names.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ambrig {
namespace {

Record With(const std::vector<std::string>& names) {
  Record r;
  r.rate = 1000;
  for (const std::string& n : names) r.channels.push_back({n, "", {1, 2}});
  return r;
}

std::string Found(const Record& r, const std::string& name) {
  const Channel* c = FindColumn(r, name);
  return c ? c->name : "";
}

TEST(FindColumn, EverySpellingOfOneChannel) {
  const Record r = With({"A.x", "A.i1", "A.r.x"});
  for (const char* name : {"A.i1", "A_i1", "/A/i1", "A/i1", "A.i1 [A]", "A.i1 (A)",
                           "/'bench'/'A.i1'", "\"Model Root\"/\"A.i1\"", "Model Root/A.i1"})
    EXPECT_EQ(Found(r, name), "A.i1") << name;
  EXPECT_EQ(Found(r, "A_r_x"), "A.r.x");
  EXPECT_EQ(Found(r, "/A/r/x"), "A.r.x");
}

// The file's own name comes first, whatever else it could mean.
TEST(FindColumn, TheFilesOwnNameComesFirst) {
  const Record r = With({"A.i1", "A_i1", "pos_ax", "A.i1 [A]"});
  EXPECT_EQ(Found(r, "A_i1"), "A_i1");
  EXPECT_EQ(Found(r, "A.i1"), "A.i1");
  EXPECT_EQ(Found(r, "A.i1 [A]"), "A.i1 [A]");
  EXPECT_EQ(Found(r, "pos_ax"), "pos_ax");
}

// An underscore in a name of another kind is part of it.
TEST(FindColumn, OtherNamesAreNotChanged) {
  const Record r = With({"pos.ax", "upper.x"});
  EXPECT_EQ(Found(r, "pos_ax"), "");
  EXPECT_EQ(Found(r, "upper_x"), "");
  EXPECT_EQ(Found(r, ""), "");
  EXPECT_EQ(Found(With({}), "A.x"), "");
}

TEST(ColumnsOf, TheNearestComeFirst) {
  const Record r = With({"bus", "A.i1", "omega", "pos_ay", "pos_ax"});
  EXPECT_EQ(ColumnsOf(r, "pos_ax1").substr(0, 14), "pos_ax, pos_ay");
  EXPECT_EQ(ColumnsOf(r, "A.i9").substr(0, 4), "A.i1");
  EXPECT_EQ(ColumnsOf(With({"bus"}), "nothing like it"), "bus");
  EXPECT_EQ(ColumnsOf(With({}), "x"), "");
}

// All of a wide file would be no help: a dozen, and how many more.
TEST(ColumnsOf, AreTwelveAndHowManyMore) {
  std::vector<std::string> names;
  for (int k = 0; k < 40; ++k) names.push_back("column" + std::to_string(k));
  const std::string text = ColumnsOf(With(names), "column7");
  EXPECT_EQ(text.substr(0, 8), "column7,");
  EXPECT_EQ(text.substr(text.size() - 12), " and 28 more");
  EXPECT_EQ(std::count(text.begin(), text.end(), ','), 11);
}

}  // namespace
}  // namespace ambrig
