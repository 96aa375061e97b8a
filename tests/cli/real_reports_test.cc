// Reports of real runs as a reader sees them: sections, figures, units, what is said of a rotor
// that dropped, and nothing in a figure after the shaft went past its poles.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/record/hdf5.h"
#include "tests/app/html_page.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using testing::CountOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class RealReports : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("rig.toml", ReferenceRigText());
  }
  Outcome RunLasting(double seconds, const std::string& more) const {
    Write("s.toml",
          Replaced(ScenarioText(more), "duration = 0.01", "duration = " + std::to_string(seconds)));
    return Ambrig("run s.toml --out out");
  }
  std::string Html() const { return ReadText(folder_ / "out/s.html"); }
  std::string Words() const { return testing::Words(Html()); }
  Json Result() const { return Json::parse(ReadText(folder_ / "out/s.json")); }

  /// Traces and layouts of the page's figures.
  std::vector<Json> Figures() const {
    std::vector<Json> out;
    const std::string html = Html(), open = "<script type=\"application/json\">";
    for (std::size_t at = html.find(open); at != std::string::npos; at = html.find(open, at)) {
      at += open.size();
      out.push_back(Json::parse(html.substr(at, html.find("</script>", at) - at)));
    }
    return out;
  }
  /// Largest finite |y| over the traces of a figure whose axis title contains `unit`.
  static double Largest(const Json& figure) {
    double largest = 0;
    for (const Json& trace : figure["data"])
      if (trace.contains("y"))
        for (const Json& y : trace["y"])
          if (y.is_number()) largest = std::max(largest, std::abs(y.get<double>()));
    return largest;
  }
};

constexpr const char* kOpenCoil =
    "[speed]\nprofile = [[0.0, 157.0]]\n[[fault]]\ntime = 0.02\ntarget = \"A.coil3\"\n"
    "kind = \"open\"\n[expect]\nclassified = \"open\"\ndrop = false\nmax_orbit = 4e-5\n";

std::string AllCoilsOpen() {
  std::string text = "[speed]\nprofile = [[0.0, 1257.0]]\n";
  for (const char* bearing : {"A", "B"})
    for (int coil = 1; coil <= 8; ++coil)
      text += std::string("[[fault]]\ntime = 0.05\ntarget = \"") + bearing + ".coil" +
              std::to_string(coil) + "\"\nkind = \"open\"\n";
  return "fault_tolerance = false\nseed = 3\n" + text;
}

// What fault, when it was seen, what was done about it: on the screen, in JSON and on the page
// alike.
TEST_F(RealReports, AnOpenCoilIsToldInOrder) {
  const Outcome o = RunLasting(0.06, kOpenCoil);
  ASSERT_EQ(o.exit, 0) << o.text;
  const std::string words = Words();
  std::size_t at = 0;
  for (const char* event : {"\nfault\nA3\nopen\n", "\ndetected\nA3\n", "\nclassified\nA3\nopen\n",
                            "\nredistributed\nA\nexact (force law as when healthy)\n"}) {
    const std::size_t next = words.find(event, at);
    ASSERT_NE(next, std::string::npos) << event << words;
    at = next;
  }
  EXPECT_THAT(words, HasSubstr("The rotor stayed up, without touching an auxiliary bearing. Every "
                               "expectation is met."));
  for (const char* head :
       {"Course of the run", "Timeline", "Expectations", "Orbits", "Positions", "Coil currents",
        "Fault detection", "Stator cross-sections", "Further channels", "Scenario and rig files"})
    EXPECT_THAT(words, HasSubstr(std::string("\n") + head + "\n")) << head;
  EXPECT_THAT(Html(), HasSubstr("A3 (faulty)"));
  const Json j = Result();
  EXPECT_EQ(std::count_if(j["events"].begin(), j["events"].end(),
                          [](const Json& e) { return e["kind"] == "fault"; }),
            1);
  EXPECT_EQ(j["expect"]["classified"]["met"], true);
  EXPECT_FALSE(j.contains("model_invalid_after"));
  EXPECT_LT(j["metrics"]["detection_delay"].get<double>(), 0.002);
  // the page and the JSON name the same orbit, to the digits of the page
  char orbit[32];
  std::snprintf(orbit, sizeof orbit, "%.2f", 1e6 * j["metrics"]["max_orbit"]["A"].get<double>());
  EXPECT_THAT(words, HasSubstr(std::string(orbit, 3)));
  EXPECT_THAT(o.text, HasSubstr(std::string(orbit) + " um"));
}

// The files that made the run stand in the page as they were written, escaped, not "as resolved".
TEST_F(RealReports, TheFilesOfTheRunAreInsideAsTheyWereRead) {
  ASSERT_EQ(RunLasting(0.01, "# a remark with <b>markup</b> & signs\n").exit, 0);
  EXPECT_THAT(Html(), HasSubstr("# a remark with &lt;b&gt;markup&lt;/b&gt; &amp; signs"));
  EXPECT_THAT(Words(), HasSubstr("As they were read."));
  EXPECT_THAT(Words(), Not(HasSubstr("defaults included")));
}

TEST_F(RealReports, AHealthyRunHasNoFaultSections) {
  ASSERT_EQ(RunLasting(0.01, "fault_tolerance = false\n").exit, 0);
  const std::string words = Words();
  EXPECT_THAT(words, Not(HasSubstr("Fault detection")));
  EXPECT_THAT(words, Not(HasSubstr("Timeline")));
  EXPECT_THAT(words, Not(HasSubstr("Expectations")));
  EXPECT_EQ(Result()["events"].size(), 0u);
  EXPECT_TRUE(Result()["metrics"]["detection_delay"].is_null());
  EXPECT_THAT(words, HasSubstr("detection delay\n–"));
  EXPECT_THAT(words, HasSubstr("false alarms\nnot watched\n"));
}

// Nothing holds the rotor: it drops, bounces, and the linear magnets would draw it through its
// poles. Orbits end at the gap, the clearance left at the poles, curves at that instant, and all
// say so.
TEST_F(RealReports, PastThePolesNothingIsAFigure) {
  const Outcome o = RunLasting(0.5, AllCoilsOpen());
  ASSERT_EQ(o.exit, 0) << o.text;
  const Json j = Result();
  ASSERT_EQ(j["drop"], true);
  ASSERT_TRUE(j.contains("model_invalid_after")) << "the scenario does not test what it should";
  const double end = j["model_invalid_after"];
  for (const char* bearing : {"A", "B"})
    EXPECT_LE(j["metrics"]["max_orbit"][bearing].get<double>(), 4e-4 * (1 + 1e-12)) << bearing;
  // gap 400 um, auxiliary bearings 200 um
  EXPECT_GE(j["metrics"]["min_clearance_left"].get<double>(), -2e-4 * (1 + 1e-9));
  EXPECT_LT(j["metrics"]["min_clearance_left"].get<double>(), 0);
  EXPECT_THAT(o.text, HasSubstr("the model is invalid after"));
  const std::string words = Words();
  EXPECT_THAT(words, HasSubstr("The rotor dropped."));
  EXPECT_THAT(words, HasSubstr("Past the poles of"));
  EXPECT_THAT(words, HasSubstr("model invalid"));
  // the record has the paths whole, the figures of positions end
  const Record record = ReadHdf5((folder_ / "out/s.h5").string());
  double furthest = 0;
  for (const double x : record.Find("A.r.x")->samples) furthest = std::max(furthest, std::abs(x));
  EXPECT_GT(furthest, 4e-4);
  const std::vector<Json> figures = Figures();
  ASSERT_GE(figures.size(), 3u);
  EXPECT_LT(Largest(figures[0]), 450) << "orbits [um]";
  bool positions = false;
  for (const Json& f : figures) {
    const std::string title = f["layout"]["yaxis"]["title"].value("text", "");
    if (title.find("position [") != 0) continue;
    positions = true;
    const double unit = title == "position [mm]" ? 1e-3 : 1e-6;
    EXPECT_LT(Largest(f) * unit, 4.5e-4) << title;
    for (const Json& trace : f["data"])
      for (std::size_t k = 0; k < trace["x"].size(); ++k)
        if (trace["x"][k].get<double>() > end + 1e-3 && title == "position [um]") {
          EXPECT_TRUE(trace["y"][k].is_null());
        }
  }
  EXPECT_TRUE(positions);
}

// Sixteen faults at one instant are one mark with one short label, not a line over the whole
// figure.
TEST_F(RealReports, ManyFaultsAtOnceShareAShortLabel) {
  ASSERT_EQ(RunLasting(0.1, AllCoilsOpen()).exit, 0);
  EXPECT_THAT(Html(), HasSubstr("16 faults"));
  EXPECT_EQ(CountOf(Words(), "\nfault\n"), 16u);  // the timeline has each
  for (const Json& f : Figures())
    for (const Json& note : f["layout"]["annotations"])
      EXPECT_LT(note["text"].get<std::string>().size(), 80u) << note;
}

// The page of several scenarios in one call is each one's own.
TEST_F(RealReports, EveryScenarioHasItsOwnFiles) {
  Write("a.toml", Replaced(ScenarioText(""), "name = \"t\"", "name = \"first\""));
  Write("b.toml", Replaced(ScenarioText(""), "name = \"t\"", "name = \"second\""));
  ASSERT_EQ(Ambrig("run a.toml b.toml --quiet --out out --json all.json --csv").exit, 0);
  EXPECT_EQ(Files(),
            "a.toml all.json b.toml out/a.csv out/a.h5 out/a.html out/a.json out/b.csv "
            "out/b.h5 out/b.html out/b.json rig.toml ");
  EXPECT_THAT(testing::Words(ReadText(folder_ / "out/b.html")), HasSubstr("second"));
  const Json all = Json::parse(ReadText(folder_ / "all.json"));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0]["name"], "first");
  EXPECT_EQ(all[1]["name"], "second");
}

TEST_F(RealReports, AnExpectationThatIsNotMetEndsWithOne) {
  const Outcome o = RunLasting(0.06, std::string(kOpenCoil) + "touchdown = true\n");
  EXPECT_EQ(o.exit, 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("expect touchdown          wanted true           got false"));
  EXPECT_THAT(o.text, HasSubstr("NOT MET"));
  EXPECT_THAT(Words(), HasSubstr("An expectation is not met."));
  EXPECT_THAT(Words(), HasSubstr("\ntouchdown\ntrue\nfalse\n✗ not met\n"));
}

// A reader of the CSV finds every channel with its unit and the rate of the scenario.
TEST_F(RealReports, TheCsvSaysUnitsAndRate) {
  Write("s.toml", ScenarioText(""));
  ASSERT_EQ(Ambrig("run s.toml --quiet --no-report --csv --out out --rate 6250").exit, 0);
  std::istringstream csv(ReadText(folder_ / "out/s.csv"));
  std::string head, first, second;
  std::getline(csv, head);
  std::getline(csv, first);
  std::getline(csv, second);
  for (const char* column : {"t [s]", "A.x [m]", "A.i1 [A]", "A.d1", "bus [V]", "omega [rad/s]"})
    EXPECT_THAT(head, HasSubstr(column));
  EXPECT_EQ(first.substr(0, 2), "0,");
  EXPECT_NEAR(std::stod(second), 1 / 6250.0, 1e-9);
  EXPECT_EQ(CountOf(head, ","), CountOf(first, ","));
}

}  // namespace
}  // namespace ambrig
