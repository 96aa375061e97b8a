// The page of the seed paper: every figure it promises, the paper's numbers beside ours.
#include "app/pages/paper_report.h"

#include <gmock/gmock.h>

#include <sstream>

#include "app/figures/paper_figures.h"
#include "tests/app/html_page.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

const PaperStudy& Study() {
  static const PaperStudy study = [] {
    PaperStudyOptions options;
    options.bits = {12};
    return RunPaperStudy(AMBRIG_SOURCE_DIR "/examples/paper", options);
  }();
  return study;
}

TEST(PaperPage, HasTheFiguresOfThePaperAndItsNumbers) {
  const std::string html = testing::Written(
                        [&](const std::string&path) { WritePaperReport(Study(), path); }),
                    words = testing::Words(html);
  for (const int figure : {4, 5, 11, 12, 13, 14, 15, 17, 18, 19, 20})
    EXPECT_THAT(words, HasSubstr("s figure " + std::to_string(figure) + ": "));
  EXPECT_THAT(words, HasSubstr("In place of figure 16"));
  for (const char* number : {"16761 - 16857", "about 12", "about 570", "about 120", "about +-700",
                             "about 1.75", "about 2"})
    EXPECT_THAT(words, HasSubstr(number));
}

TEST(PaperPage, TextFitsATerminal) {
  std::istringstream text(PaperText(Study()));
  for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_EQ(PaperJson(Study())["converters"].size(), 1u);
}

// A figure shows the record that it is drawn from.
TEST(PaperPage, SamplingPointsAreThoseOfTheRecord) {
  const Figure f = PaperSamplingPoints(Study().open, 13);
  const auto& normal = f.traces[1]["y"];
  ASSERT_EQ(normal.size(), 72u);
  const auto& all = Study().open.result.record.Find("M.i1")->samples;
  const auto at = static_cast<std::size_t>((0.03 - 10 * 4e-5) * 450e3 + 0.5);
  for (std::size_t k = 0; k < 72; ++k) EXPECT_NEAR(normal[k], all[at + k], 1e-5) << k;
  for (const auto& i : f.traces[3]["y"]) EXPECT_LT(std::abs(i.get<double>()), 0.01);
}

TEST(PaperPage, FlagFallsWhereTheDetectorRaisedIt) {
  const Figure f = PaperFlag(Study().shorted, 20);
  const double flagged = Study().shorted.look.flagged - 0.03;
  ASSERT_GT(flagged, 0);
  EXPECT_NEAR(f.traces[0]["x"][1], flagged * 1e3, 1e-4);
  EXPECT_EQ(f.traces[0]["y"][0], 1);
  EXPECT_EQ(f.traces[0]["y"][2], 0);
}

}  // namespace
}  // namespace ambrig
