// What is left of a bearing after coil failures, in words, on the page: from figures that are
// written down.
#include "app/pages/redistribute_report.h"

#include <gmock/gmock.h>

#include "rig/rig_file.h"
#include "tests/app/html_page.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using testing::CountOf;
using ::testing::HasSubstr;
using ::testing::Not;

MapReach Reach(bool carries, double margin, double worst, int direction) {
  MapReach r;
  r.carries = carries;
  r.margin = margin;
  r.worst = worst;
  r.worst_direction = direction;
  for (double& radius : r.radius) radius = carries ? 2 * worst : 0;
  return r;
}

RedistributionFigures Figures() {
  RedistributionFigures f;
  f.rig = "reference";
  f.bearing = "A";
  f.load = {0, -21.4};
  f.most = 60;
  f.healthy = Reach(true, 2.8, 35.5, 18);
  f.sets = {{{3}, "W, exact", Reach(true, 1.9, 18.25, 6)},
            {{1, 2, 3}, "none", Reach(false, 0, 0, 0)}};
  return f;
}

std::vector<std::string> Lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::string RedistributePage(const RedistributionFigures& f) {
  const RigParameters rig = ReadRigText(ReferenceRigText(), "rig.toml");
  return testing::Written(
      [&](const std::string& path) { WriteRedistributionReport(rig, f, path); });
}

TEST(RedistributionWords, SetsAreNamedByTheirCoils) {
  EXPECT_EQ(SetText({3}), "{3}");
  EXPECT_EQ(SetText({1, 2, 8}), "{1,2,8}");
}

// A line each: what a run goes to, whether it carries, by how much, and where it is weakest.
TEST(RedistributionWords, OneLineASet) {
  const auto lines = Lines(RedistributionText(Figures()));
  ASSERT_GE(lines.size(), 6u);
  EXPECT_THAT(lines[0], HasSubstr("worst [N]"));
  EXPECT_THAT(lines[1], ::testing::MatchesRegex("healthy +W, exact +yes +2\\.80 +35\\.5 +270"));
  EXPECT_THAT(lines[2], ::testing::MatchesRegex("\\{3\\} +W, exact +yes +1\\.90 +18\\.2 +90"));
  EXPECT_THAT(lines[3], ::testing::MatchesRegex("\\{1,2,3\\} +none +NO +- +- +-"));
  EXPECT_EQ(lines[4], "load: (0.00, -21.40) N; commands up to 60 N an axis");
  EXPECT_EQ(lines[5], "1 of 2 sets carry the load");
}

// Every head has its meaning below, and nothing is wider than the terminal.
TEST(RedistributionWords, HaveTheirLegend) {
  const std::string text = RedistributionText(Figures());
  for (const char* word : {"\nmap  ", "\ncarries  ", "margin:", "\nworst  "})
    EXPECT_THAT(text, HasSubstr(word)) << word;
  for (const std::string& line : Lines(text)) EXPECT_LE(line.size(), 80u) << line;
}

TEST(RedistributionWords, OneSetIsToldInASentence) {
  RedistributionFigures f = Figures();
  f.sets.pop_back();
  EXPECT_THAT(RedistributionText(f), HasSubstr("\ncarries the weight with margin 1.90\n"));
  f.sets = {Figures().sets[1]};
  EXPECT_THAT(RedistributionText(f), HasSubstr("\nthe load is NOT carried: the rotor drops\n"));
}

// Weightless: there is no margin to speak of, only the reach.
TEST(RedistributionWords, WithoutALoadThereIsNoMargin) {
  RedistributionFigures f = Figures();
  f.load = {0, 0};
  f.sets.pop_back();
  const std::string text = RedistributionText(f);
  EXPECT_THAT(text, HasSubstr("\nno load to carry\n"));
  EXPECT_THAT(text, HasSubstr("load: (0.00, 0.00) N"));
  EXPECT_THAT(Lines(text)[2], ::testing::MatchesRegex("\\{3\\} +W, exact +yes +- +18\\.2 +90"));
  f.load = {-0.0, -0.0};
  EXPECT_THAT(RedistributionText(f), Not(HasSubstr("-0.00")));
}

// The poles are drawn of no instant: no flux and no displacement is written at them.
TEST(RedistributionPage, PolesShowNoFigureThatIsNone) {
  RedistributionFigures f = Figures();
  f.load = {-0.0, 0.0};
  const std::string html = RedistributePage(f);
  EXPECT_THAT(html, Not(HasSubstr("0 Wb")));
  EXPECT_THAT(html, Not(HasSubstr("0 m of")));
  EXPECT_THAT(testing::Words(html), Not(HasSubstr("(-0.00")));
}

TEST(RedistributionPage, SaysTheSameAsTheScreen) {
  const std::string words = testing::Words(RedistributePage(Figures()));
  EXPECT_THAT(words, HasSubstr("rig reference, bearing A"));
  EXPECT_THAT(words, HasSubstr("(0.00, -21.40) N"));
  EXPECT_THAT(words, HasSubstr("\n{3}\nW, exact\nyes\n1.90\n18.2\n90\n"));
  EXPECT_THAT(words, HasSubstr("\n{1,2,3}\nnone\nno\n-\n-\n-\n"));
  EXPECT_THAT(words, HasSubstr("\nworst [N]\n"));
}

// A drawing of the poles and one of the forces for each set; a set without a map draws none of its
// own.
TEST(RedistributionPage, HasPicturesOfEverySetWhileTheyAreFew) {
  const std::string html = RedistributePage(Figures());
  EXPECT_EQ(CountOf(html, "<figure id="), 4u);
  EXPECT_THAT(html, HasSubstr("{3} open"));
  EXPECT_THAT(html, HasSubstr("force x [N]"));
  RedistributionFigures many = Figures();
  many.sets.assign(13, many.sets.front());
  const std::string table = RedistributePage(many);
  EXPECT_EQ(CountOf(table, "<figure id="), 0u);
  EXPECT_EQ(CountOf(testing::Words(table), "\n{3}\n"), 13u);
  EXPECT_THAT(testing::Words(table), Not(HasSubstr("Pictures")));
}

// The closed outline stands about the load: its rightmost point is the load and the reach to the
// right.
TEST(RedistributionPage, ForcesAreDrawnFromTheLoad) {
  RedistributionFigures f = Figures();
  f.load = {3, -20};
  f.sets.pop_back();
  const std::string html = RedistributePage(f);
  EXPECT_THAT(html, HasSubstr("39.5"));  // 3 + 2 * 18.25
}

}  // namespace
}  // namespace ambrig
