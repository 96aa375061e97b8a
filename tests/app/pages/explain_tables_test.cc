// Tables of the explain report and what all reports of discovery share, from explanations written
// by hand.
#include "app/pages/explain_tables.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "app/pages/discovery_parts.h"
#include "app/pages/discovery_report.h"
#include "effects/catalogue.h"
#include "rig/rig_file.h"
#include "tests/app/html_page.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using testing::CountOf;
using ::testing::HasSubstr;
using ::testing::Not;

EffectInstance Gain(double value, double sd) {
  EffectInstance e = MakeInstance(EffectNamed("sensor-gain"), "A.x");
  e.Set("gain", value);
  e.sd.assign(e.values.size(), sd);
  return e;
}

RankedEffect Ranked(const EffectInstance& e, double probability, double ratio) {
  RankedEffect r;
  r.effect = e;
  r.probability = probability;
  r.fit.ratio_fit = r.fit.ratio_validate = ratio;
  r.fit.converged = true;
  return r;
}

/// The words that `add` puts into a report.
template <class Add>
std::string TablesPage(const Add& add) {
  HtmlReport report("T", "S");
  add(report);
  return report.Html();
}

TEST(ExplainTables, TheRankingSaysWhatIsAdoptedAndWhatLosesTheRotor) {
  Explanation e;
  e.verdict = ExplanationVerdict::kEffect;
  e.base_ratio_validate = 4.75;
  e.ranking = {Ranked(Gain(1.08, 0.002), 0.97, 1.02),
               Ranked(MakeInstance(EffectNamed("sensor-offset"), "A.x"), 0.03, kInfinity)};
  e.adopted = {e.ranking[0].effect};
  const std::string html = TablesPage([&](HtmlReport&r) { AddRanking(r, e); }),
                    words = testing::Words(html);
  EXPECT_THAT(words, HasSubstr("\n1\nsensor-gain at A.x\n97.0 %\n4.750\n1.020\n1.020\n"));
  EXPECT_THAT(words, HasSubstr("\n2\nsensor-offset at A.x\n3.0 %\n4.750\nloses the rotor\n–\n"));
  EXPECT_EQ(CountOf(html, "<td class=\"ok \">sensor-gain at A.x"), 1u);
  for (const char* id : {"sensor-gain", "sensor-offset"})
    EXPECT_THAT(html, HasSubstr(EffectNamed(id).title)) << id;
  EXPECT_THAT(words, Not(HasSubstr("No candidate met the acceptance criterion")));
}

TEST(ExplainTables, ASecondRoundIsCalledOverfittingUnlessItWasTaken) {
  Explanation e;
  e.verdict = ExplanationVerdict::kEffect;
  e.ranking = {Ranked(Gain(1.08, 0.002), 1, 1.3)};
  e.second_round = {Ranked(MakeInstance(EffectNamed("sensor-offset"), "A.x"), 1, 1.29)};
  e.adopted = {e.ranking[0].effect};
  const auto words = [&] {
    return testing::Words(TablesPage([&](HtmlReport& r) { AddRanking(r, e); }));
  };
  EXPECT_THAT(words(), HasSubstr("the improvement may be due to overfitting"));
  e.second_beside = {"sensor-gain at A.x"};
  EXPECT_THAT(words(), HasSubstr("one more effect beside sensor-gain at A.x."));
  e.adopted.push_back(e.second_round[0].effect);
  EXPECT_THAT(words(), HasSubstr("The green one met the acceptance criterion as well."));
}

TEST(ExplainTables, WithoutCandidatesItSaysWhy) {
  Explanation e;
  const auto words = [&](ExplanationVerdict verdict) {
    e.verdict = verdict;
    return testing::Words(TablesPage([&](HtmlReport& r) { AddRanking(r, e); }));
  };
  EXPECT_THAT(words(ExplanationVerdict::kParameters), HasSubstr("nothing was left to explain"));
  EXPECT_THAT(words(ExplanationVerdict::kUnknown),
              HasSubstr("None could be fitted to these records."));
}

TEST(ExplainTables, ScreeningShowsTheFifteenBestAgainstTheErrorWithoutAny) {
  Explanation e;
  e.base_ratio_validate = 6.5;
  EXPECT_EQ(CountOf(TablesPage([&](HtmlReport& r) { AddScreening(r, e); }), "<figure"), 0u);
  Candidate c;
  c.effect = Gain(1.01, 0);
  c.ratio_validate = 2.5;
  e.screened.assign(40, c);
  const std::string html = TablesPage([&](HtmlReport& r) { AddScreening(r, e); });
  EXPECT_THAT(html, HasSubstr("15 of 40"));
  EXPECT_THAT(html, HasSubstr("\"x0\":6.5"));
}

// 1.08 with an sd of 0.002 is 40 sd from the gain of 1; a mass of -3 sd is a warning.
TEST(ExplainTables, TheCostNamesDistancesAndStrainedParameters) {
  Explanation e;
  e.adopted = {Gain(1.08, 0.002)};
  e.final_fit.hypothesis = Hypothesis::Base(ReadRigText(ReferenceRigText(), "rig.toml"));
  for (std::size_t k = 0; k < e.final_fit.hypothesis.free.size(); ++k) {
    FreeParameter& p = e.final_fit.hypothesis.free[k];
    if (p.path == "rotor.mass") e.final_fit.hypothesis.Set(k, p.start - 3 * p.sd);
  }
  e.final_fit.sd.assign(e.final_fit.hypothesis.free.size(), 0.001);
  const std::string words = testing::Words(TablesPage([&](HtmlReport& r) { AddCost(r, e); }));
  EXPECT_THAT(words, HasSubstr("1 more number in the model"));
  EXPECT_THAT(words, HasSubstr("\n40 sd\n"));
  EXPECT_THAT(words, HasSubstr("\nrotor.mass\n"));
  EXPECT_THAT(words, HasSubstr("\n-3.00 sd\n"));
  EXPECT_THAT(words, HasSubstr("rotor.mass (-3.0 sd)."));
  const double n = static_cast<double>(e.final_fit.hypothesis.free.size());
  EXPECT_THAT(words, HasSubstr(fmt::format("moved by {:.2f} sd rms", 3 / std::sqrt(n))));
}

TEST(ExplainTables, LinesAreJoined) { EXPECT_EQ(OneLine("a\nb\nc"), "a b c"); }

Unexplained Law(const std::string& formula, const std::string& where,
                const std::string& dependence) {
  Unexplained u;
  u.formula = formula;
  u.where = where;
  u.dependence = dependence;
  return u;
}

// Functions, numbers and what the simulator knows are no parameters; the law's own hints are
// values.
TEST(FormulaSnippetText, DeclaresEveryFreeLetterOnce) {
  const std::string text = FormulaSnippet(Law(
      "force = { x = \"-kxx*x - kxy*y + 2.5e-3*sin(theta)\", y = \"-kxy*x\" }  # kxx = 4200 N/m",
      "plane A, worst at A.x", "position (linear)"));
  EXPECT_THAT(text, HasSubstr("target = \"A\""));
  EXPECT_EQ(CountOf(text, "parameters."), 2u);
  EXPECT_THAT(text, HasSubstr("parameters.kxx = { value = 4.2e+03, null = 0, min = -1e+06"));
  EXPECT_THAT(text, HasSubstr("parameters.kxy = { value = 1e+03, null = 0"));
  const RigParameters rig = ReadRigText(ReferenceRigText() + "\n" + text, "rig.toml");
  EXPECT_EQ(rig.effects.back().values[0], 4200);
}

TEST(FormulaSnippetText, FrictionAndPlacesDoNotSwitchTheForceOff) {
  const std::string text = FormulaSnippet(Law(
      "force = { x = \"-k*max(x - c, 0)*(1 - mu)\", y = \"0\" }", "B.x", "position on one side"));
  EXPECT_THAT(text, HasSubstr("target = \"B\""));
  EXPECT_THAT(text, HasSubstr("parameters.mu = { value = 0.1, min = 0, max = 1, unit = \"-\" }"));
  EXPECT_THAT(text, HasSubstr("parameters.c = { value = 2e-05, min = 0"));
  EXPECT_THAT(text, HasSubstr("parameters.k = { value = 1e+05, null = 0"));
}

TEST(DiscoveryParts, ValuesAndTheirSdHaveOneUnit) {
  EXPECT_EQ(EffectName(Gain(1, 0)), "sensor-gain at A.x");
  EXPECT_THAT(ValueText(3200, 140, "Hz"), HasSubstr("3.20 ± 0.14"));
  EXPECT_THAT(ValueText(3200, 140, "Hz"), HasSubstr("kHz"));
  EXPECT_THAT(ValueText(3200, 0, "Hz"), Not(HasSubstr("±")));
  EXPECT_THAT(ParametersText(Gain(1.08, 0.002)), HasSubstr("gain = 1.08"));
}

TEST(ExplainText, NamesThatASetLeavesOpen) {
  Explanation e;
  e.adopted = {Gain(1.08, 0.002)};
  EXPECT_EQ(AnswerText(e), "sensor-gain at A.x");  // judged by nothing else
  e.set = {{"sensor-gain", "A.x", 0.97}};
  EXPECT_EQ(AnswerText(e), "sensor-gain at A.x");
  EXPECT_EQ(DoubtText(e), "");
  e.set = {{"sensor-gain", "A.x", 0.56}, {"unknown", "", 0.42}};
  EXPECT_EQ(AnswerText(e), "sensor-gain at A.x (56 %) or no effect of the catalogue (42 %)");
  EXPECT_EQ(DoubtText(e), "no effect is certain");
  e.set = {{"sensor-gain", "A.x", 0.5}, {"side-pull", "A", 0.5}};
  EXPECT_EQ(DoubtText(e), "more than one effect remains");
  // A further effect has a set of its own.
  e.set = {{"sensor-gain", "A.x", 0.97}};
  e.adopted.push_back(MakeInstance(EffectNamed("sensor-offset"), "B.y"));
  EXPECT_EQ(AnswerText(e), "sensor-gain at A.x and sensor-offset at B.y");
  e.further_sets["sensor-offset at B.y"] = {{"sensor-offset", "B.y", 0.6}, {"bow", "rig", 0.4}};
  EXPECT_EQ(AnswerText(e),
            "sensor-gain at A.x and sensor-offset at B.y (60 %) or bow at rig (40 %)");
  EXPECT_EQ(DoubtText(e), "more than one effect remains");
}

// A probability of 1.000 among the candidates is no adoption: the terminal says why not, as the
// page does.
TEST(ExplainText, WhyTheBestCandidateIsNotAdopted) {
  Explanation e;
  e.ranking = {Ranked(Gain(1.08, 0.002), 1, 3.5)};
  e.verdict = ExplanationVerdict::kUnknown;
  EXPECT_EQ(WhyNot(e, true),
            "sensor-gain at A.x is not adopted: the rig's parameters explain the records as well.");
  e.remainder.kind = RemainderKind::kOther;
  EXPECT_EQ(WhyNot(e, true),
            "sensor-gain at A.x is not adopted: with it 3.50 times the noise is left on the fitted "
            "and 3.50 on the unseen records, which the noise alone does not make. Its probability "
            "counts only the candidates listed.");
  EXPECT_THAT(WhyNot(e, false), Not(HasSubstr("unseen")));
  e.verdict = ExplanationVerdict::kParameters;
  e.final_ratio_validate = 1.031;
  EXPECT_THAT(
      WhyNot(e, true),
      HasSubstr("the rig file and its tolerances explain the records to 1.031 of the noise, "
                "with it to"));
  e.nuisances.emplace_back();
  EXPECT_THAT(WhyNot(e, true), HasSubstr("tolerances and what differs from record to record"));
  e.verdict = ExplanationVerdict::kEffect;
  e.adopted = {e.ranking[0].effect};
  EXPECT_EQ(WhyNot(e, true), "");
}

TEST(DiscoveryParts, TheLadderNamesEveryStep) {
  const std::string html = TablesPage([](HtmlReport& r) {
    AddLadder(r, {{"", 9, 8},
                  {"parameters", 8, 7.5},
                  {"eddy-currents at A", 1.2, 1.1},
                  {"without an effect of no size", 1.3, 1.2}});
  });
  for (const char* step : {"rig file as it is", "+ rig parameters fitted", "+ eddy-currents at A",
                           "without an effect of no size"})
    EXPECT_THAT(html, HasSubstr(step));
  EXPECT_THAT(html, Not(HasSubstr("+ without")));
  EXPECT_THAT(
      html,
      HasSubstr("\"xanchor\":\"left\""));  // "noise" stands beside the bars, not on the last one
}

// The colours of two maps that are to be compared end at one value; numbers are printed where they
// fit.
TEST(DiscoveryParts, RatioMapsShareTheirColours) {
  const std::vector<std::vector<double>> values = {{1, 30}, {2, std::nan("")}};
  Figure f = RatioFigure({"A.x", "A.y"}, {"r1", "r2"}, values, "map");
  EXPECT_EQ(f.traces.back()["zmin"], 1);
  EXPECT_EQ(f.traces.back()["zmax"], 10);
  f = RatioFigure({"A.x", "A.y"}, {"r1", "r2"}, {{1, 3}, {2, 2}}, "map", 5);
  EXPECT_EQ(f.traces.back()["zmax"], 5);
  f = RatioFigure({"A.x", "A.y"}, {"r1", "r2"}, {{1, 1.5}, {1, 1}}, "map");
  EXPECT_EQ(f.traces.back()["zmax"], 2);  // noise alone is not blown up
}

TEST(DiscoveryParts, TheLargestRatioIsOverRecordsAndChannels) {
  Comparison c;
  c.records.resize(2);
  c.records[0].channels = {{"A.x", 0, 0, 0, 2.0, 0}};
  c.records[1].channels = {{"A.x", 0, 0, 0, 1.0, 0}, {"A.y", 0, 0, 0, 7.0, 0}};
  EXPECT_EQ(LargestRatio(c), 7);
  EXPECT_EQ(LargestRatio({}), 0);
}

// The snippet is read by the reader of rig files as it stands.
TEST(FormulaSnippetText, IsAFormulaThatTheRigFileTakes) {
  Unexplained u;
  u.where = "plane B, worst at B.y";
  u.dependence = "position on one side: contact at 40 degrees";
  u.formula =
      "force = { x = \"-k*max(0.766*x + 6.4e-1*y - c, 0)*(0.766 - mu*0.643)\", y = \"0\" }  # c = "
      "2.1e-05 m, mu: friction";
  const std::string text = FormulaSnippet(u);
  EXPECT_THAT(text, HasSubstr("target = \"B\""));
  EXPECT_THAT(text, HasSubstr("parameters.c = { value = 2.1e-05, min"));
  EXPECT_THAT(text, Not(HasSubstr("max = {"))) << "functions are no parameters";
  const std::string file =
      std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml";
  std::ifstream in(file);
  std::ostringstream rig;
  rig << in.rdbuf() << "\n" << text;
  const RigParameters read = ReadRigText(rig.str(), "rig.toml");
  ASSERT_FALSE(read.effects.empty());
  EXPECT_EQ(read.effects.back().table.size(), 3u);  // k, c, mu
}

}  // namespace
}  // namespace ambrig
