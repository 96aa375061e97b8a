// Numbers, series, figures and the progress bar of reports.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include "app/commands/progress.h"
#include "app/figures/figure.h"
#include "app/figures/series.h"
#include "app/pages/html.h"
#include "app/text/format.h"
#include "app/text/screen.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
const std::string kGap = "\u00a0", kThin = "\u202f";

TEST(Format, SiPrefixes) {
  EXPECT_EQ(FormatSi(36.24e-6, "m"), "36.2" + kGap + "µm");
  EXPECT_EQ(FormatSi(16800, "A/s"), "16.8" + kGap + "kA/s");
  EXPECT_EQ(FormatSi(-1.75e-3, "H"), "-1.75" + kGap + "mH");
  EXPECT_EQ(FormatSi(999.96e-6, "m"), "1" + kGap + "mm");  // rounds over the edge of a prefix
  EXPECT_EQ(FormatSi(0, "V"), "0" + kGap + "V");
  EXPECT_EQ(FormatSi(1e290, "m"), "1e+290" + kGap + "m");
  EXPECT_EQ(FormatSi(1e-310, "s"), "1e-310" + kGap + "s");  // smaller than a normal double
  EXPECT_EQ(FormatSi(12000, "rpm", 5), "12" + kThin + "000" + kGap + "rpm");
  EXPECT_EQ(FormatSi(std::nan(""), "A"), "–");  // what was not measured has no unit
  EXPECT_EQ(FormatSi(0.5, "-"), "0.5");
}

TEST(Format, Numbers) {
  EXPECT_EQ(FormatNumber(1e6), "1" + kThin + "000" + kThin + "000");
  EXPECT_EQ(FormatNumber(-12345.6, 6), "-12" + kThin + "345.6");
  EXPECT_EQ(FormatNumber(1500), "1500");
  EXPECT_EQ(FormatNumber(0.1), "0.1");
  EXPECT_EQ(FormatNumber(3e-7), "3e-07");
}

TEST(Format, Markup) {
  EXPECT_EQ(InlineMarkup("**a** < *b* `c`"), "<strong>a</strong> &lt; <em>b</em> <code>c</code>");
  EXPECT_EQ(InlineMarkup("2 * 3 * 4"), "2 * 3 * 4");
  EXPECT_EQ(InlineMarkup("**open"), "**open");
}

TEST(Series, DecimateKeepsExtremesEndsAndGaps) {
  std::vector<double> x(100000), y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = static_cast<double>(i);
    y[i] = std::sin(1e-3 * x[i]);
  }
  y[12345] = 7;
  y[54321] = -8;
  y[77777] = std::nan("");
  const Points p = Decimate(x, y, 1000);
  EXPECT_LE(p.x.size(), 1010u);
  EXPECT_TRUE(std::ranges::is_sorted(p.x));
  EXPECT_EQ(p.x.front(), 0);
  EXPECT_EQ(p.x.back(), 99999);
  EXPECT_EQ(std::ranges::count(p.y, 7.0), 1);
  EXPECT_EQ(std::ranges::count(p.y, -8.0), 1);
  EXPECT_EQ(std::ranges::count_if(p.y, [](double v) { return std::isnan(v); }), 1);
  // Every point kept is a point of the series.
  for (std::size_t k = 0; k < p.x.size(); ++k)
    if (!std::isnan(p.y[k])) {
      EXPECT_EQ(p.y[k], y[static_cast<std::size_t>(p.x[k])]);
    }
}

TEST(Series, ShortSeriesStayAndOrbitsKeepTheirPeak) {
  const std::vector<double> x = {0, 1, 2}, y = {3, 4, 5};
  EXPECT_EQ(Decimate(x, y, 4000).y, y);
  std::vector<double> a(50000), b(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = std::cos(0.01 * static_cast<double>(i));
    b[i] = std::sin(0.01 * static_cast<double>(i));
  }
  a[33333] = 3;
  const Points p = DecimateOrbit(a, b, 2000);
  EXPECT_EQ(*std::ranges::max_element(p.x), 3);
}

TEST(Series, DisplayUnits) {
  EXPECT_EQ(ChooseUnit(3.6e-5, "m").name, "µm");
  EXPECT_DOUBLE_EQ(ChooseUnit(3.6e-5, "m").factor * 3.6e-5, 36);
  EXPECT_EQ(ChooseUnit(16800, "A/s").name, "kA/s");
  EXPECT_EQ(ChooseUnit(2, "A").factor, 1);
  EXPECT_EQ(ChooseUnit(12000, "rpm").factor, 1);
  EXPECT_EQ(ChooseUnit(0, "m").name, "m");
  EXPECT_EQ(ChooseUnit(0.002, "m").name, "mm");  // milli, not metre
}

TEST(FigureParts, NumbersAreShortAndGapsNull) {
  const std::vector<double> v = {1.0 / 3, std::nan(""), 2, 1e-7};
  EXPECT_EQ(Numbers(v, 4).dump(), "[0.3333,null,2,1e-07]");
}

TEST(FigureParts, HistogramCountsEverything) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> v(2000);
  for (double& e : v) e = normal(random);
  v.push_back(std::nan(""));
  Figure f = MakeFigure("c");
  AddHistogram(f, 0, "h", v, 21);
  int sum = 0;
  for (const auto& count : f.traces[0]["y"]) sum += count.get<int>();
  EXPECT_EQ(sum, 2000);
}

TEST(FigureParts, GridPanelsDoNotOverlap) {
  Grid grid;
  grid.rows = 3;
  grid.columns = 2;
  const Figure f = MakeFigure("c", grid);
  EXPECT_EQ(f.panels, 6);
  const auto domain = [&](const char* axis) {
    return f.layout[axis]["domain"].get<std::array<double, 2>>();
  };
  EXPECT_LT(domain("xaxis")[1], domain("xaxis2")[0]);
  EXPECT_LT(domain("yaxis3")[1], domain("yaxis")[0]);
  EXPECT_LT(domain("yaxis5")[1], domain("yaxis3")[0]);
  EXPECT_EQ(f.layout["xaxis3"]["matches"], "x");
}

TEST(FigureParts, MarksCloseTogetherShareALabel) {
  Figure f = MakeFigure("c");
  const std::vector<Mark> marks = {{1.0, "fault"}, {1.001, "detected"}, {5, "drop"}, {20, "late"}};
  AddMarks(f, marks, {0, 10});
  ASSERT_EQ(f.layout["annotations"].size(), 2u);
  EXPECT_EQ(f.layout["annotations"][0]["text"], "fault · detected");
  EXPECT_EQ(f.layout["shapes"].size(), 3u);
}

// A rotor that bounces: each word once, not a label as long as the figure is wide.
TEST(FigureParts, MarksOfABouncingRotorShareAShortLabel) {
  Figure f = MakeFigure("c");
  std::vector<Mark> marks;
  for (int k = 0; k < 6; ++k)
    marks.push_back({1 + 0.01 * k, k % 2 == 0 ? "touchdown" : "lift off"});
  AddMarks(f, marks, {0, 10});
  ASSERT_EQ(f.layout["annotations"].size(), 1u);
  EXPECT_EQ(f.layout["annotations"][0]["text"], "touchdown · lift off");
}

TEST(Html, TextBlocksAndTable) {
  HtmlReport r("T", "S");
  r.Text("one\ntwo\n\n- a\n- b\nafter");
  r.Table({"k", "v"}, {{"x", "1.5 mm"}, {"y", Cell("bad", "fail")}, {"z", "3dof"}});
  const std::string html = r.Html();
  EXPECT_THAT(html, HasSubstr("<p>one two</p>\n<ul>\n<li>a</li>\n<li>b</li>\n</ul>\n<p>after</p>"));
  EXPECT_THAT(html, HasSubstr("<td class=\" num\">1.5 mm</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"fail \">bad</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\" \">3dof</td>"));
}

TEST(ProgressBar, TextAndTimeLeft) {
  EXPECT_EQ(ProgressText(0.5, 10, 4), "[##--]  50 %  00:10 left");
  EXPECT_EQ(ProgressText(0, 10, 4), "[----]   0 %");
  EXPECT_EQ(ProgressText(1, 3661, 4), "[####] 100 %  1:01:01");
  EXPECT_EQ(ProgressText(std::nan(""), 1, 4), "[----]   0 %");
}

// One line of a terminal, or it scrolls with every redraw.
TEST(ProgressBar, StaysNarrowerThanTheTerminal) {
  const std::string text = "123/456 runs, 3.1/s, 12 dropped, and then something longer than that";
  for (const std::size_t columns : {20u, 40u, 80u, 200u}) {
    const std::string line = ProgressLine("a scenario with a long name of its own, at 12 000 rpm",
                                          0.5, 100, text, columns);
    EXPECT_LT(ScreenWidth(line), columns) << line;
  }
  EXPECT_EQ(ProgressLine("campaign", 0.5, 10, "12/24 runs, 3.1/s, 2 dropped", 80),
            "campaign [########--------]  50 %  00:10 left  12/24 runs, 3.1/s, 2 dropped");
}

TEST(Screen, WrapsAtSpacesAndKeepsPathsWhole) {
  EXPECT_EQ(Wrapped("  note: one two three four", 8, 16),
            "  note: one two\n        three\n"
            "        four");
  EXPECT_EQ(Wrapped("see /a/very/long/path/that/stays.toml", 2, 12),
            "see\n  /a/very/long/path/that/stays.toml");
  EXPECT_EQ(Wrapped("A.x is wrong; to mend it: use = false", 2, 12),
            "A.x is\n  wrong;\n  to mend it: use = false");
  EXPECT_EQ(Wrapped("it is 99.9 % sure", 2, 10), "it is\n  99.9 %\n  sure");
  EXPECT_EQ(ScreenWidth("\033[32mµm\033[0m"), 2u);
  EXPECT_EQ(Shortened("abcdefgh", 6), "abc...");
  EXPECT_EQ(ScreenSi(3.62e-5, "m"), "36.2 um");
  EXPECT_EQ(ScreenSi(std::nan(""), "m"), "-");
}

TEST(Screen, HelpGoesOnBelowItsDescription) {
  EXPECT_EQ(WrappedHelp("  --rate NUMBER   rows of the record per second", 40),
            "  --rate NUMBER   rows of the record per\n                  second");
  const std::string example = "  ambrig run a/very/long/path/of/a/scenario.toml --out out";
  EXPECT_EQ(WrappedHelp(example, 40), example);
}

TEST(ProgressBar, ManyThreadsOneLineAndSilentWithoutTerminal) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  {
    Progress quiet("quiet", ends[1], false);
    quiet.Update(0.5);
    Progress bar("work", ends[1], true);
    std::vector<std::jthread> threads;
    for (int n = 0; n < 4; ++n)
      threads.emplace_back([&bar] {
        for (int k = 0; k < 100000; ++k) bar.Update(k / 1e5, "x");
      });
  }
  close(ends[1]);
  std::string out(65536, '\0');
  const ssize_t size = read(ends[0], out.data(), out.size());
  close(ends[0]);
  ASSERT_GT(size, 0);
  out.resize(static_cast<std::size_t>(size));
  EXPECT_THAT(out, Not(HasSubstr("quiet")));
  EXPECT_THAT(out, HasSubstr("\rwork ["));
  EXPECT_TRUE(out.ends_with("\r\x1b[K"));
  EXPECT_LT(std::ranges::count(out, '['), 400);  // redrawn by time, not by call
}

}  // namespace
}  // namespace ambrig
