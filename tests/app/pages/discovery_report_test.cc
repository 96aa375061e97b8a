// Reports of compare, explain and adopt from two short records of the reference rig whose
// "measurements" are simulated with a hidden side pull at A.
#include "app/pages/discovery_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

#include "app/figures/residual_data.h"
#include "app/figures/response_figures.h"
#include "app/pages/explain_tables.h"
#include "effects/formula.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "simulation/switching/switching_engine.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

const char* kForced = R"(name = "multisine"
rig = "rig.toml"
duration = 0.06
record_rate = 12500.0
seed = 5
start.state = "levitated"
speed.profile = [[0.0, 0.0], [0.06, 0.0]]
[[excitation]]
target = "A.x"
port = "force"
kind = "multisine"
start = 0.0
stop = 0.06
frequencies = [50.0, 100.0, 200.0]
phases = [0.0, 1.0, 2.0]
amplitude = 3.0
)";

const char* kSpinning = R"(name = "spinning"
rig = "rig.toml"
duration = 0.1
record_rate = 12500.0
seed = 6
start.state = "levitated"
speed.profile = [[0.0, 1500.0], [0.1, 1500.0]]
[[excitation]]
target = "A.x"
port = "reference"
kind = "step"
start = 0.02
stop = 0.08
amplitude = 3e-5
)";

EffectInstance SidePull() {
  EffectInstance e = MakeInstance(*FindEffect("side-pull"), "A");
  e.Set("stiffness", 2e4);
  return e;
}

CaseRecord MeasuredRecord(const RigParameters& truth, const RigParameters& rig,
                          const std::string& text, const std::string& name, bool validate) {
  CaseRecord r;
  r.data_file = "folder/" + name + ".h5";
  r.scenario = ReadScenarioText(text, name + ".toml", rig);
  r.validate = validate;
  const Record full = SwitchingEngine(truth, r.scenario, {}).Run().record;
  r.data.rate = full.rate;
  r.data.start = full.start;
  for (const char* channel : {"A.x", "A.y", "B.x", "A.i1", "A.i2", "bus"})
    if (const Channel* c = full.Find(channel)) r.data.channels.push_back(*c);
  for (const Channel& c : r.data.channels)
    r.quality.push_back({c.name, "good", true, std::vector<char>(c.samples.size(), 1), 0, 0});
  return r;
}

class DiscoveryReport : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    case_ = new Case;
    case_->file = "folder/case.toml";
    case_->rig = ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
    case_->rig.effects.clear();
    RigParameters truth = case_->rig;
    truth.effects.push_back(SidePull());
    case_->records.push_back(MeasuredRecord(truth, case_->rig, kForced, "record-1", false));
    case_->records.push_back(MeasuredRecord(truth, case_->rig, kSpinning, "record-2", true));
    case_->notes = {"nothing was <left> out"};
    model_ = new CaseModel(*case_);
    before_ = new Comparison(Compare(*model_, Hypothesis::Base(case_->rig), false));
    before_->records[0].blocks = {{"coil", 1.02}, {"rotor", 4.5}};
  }
  static void TearDownTestSuite() {
    delete before_;
    delete model_;
    delete case_;
  }

  static Hypothesis True() {
    Hypothesis h = Hypothesis::Base(case_->rig);
    h.AddEffect(SidePull());
    return h;
  }

  /// What Explain would have found, written by hand.
  static Explanation Found() {
    Explanation e;
    e.verdict = ExplanationVerdict::kEffect;
    RankedEffect r;
    r.effect = SidePull();
    r.effect.sd[0] = 300;
    r.probability = 0.97;
    r.fit.hypothesis = True();
    r.fit.predicted = *model_->Predict(True());
    r.fit.sd.assign(r.fit.hypothesis.free.size(), 1e-9);
    r.fit.converged = true;
    r.fit.ratio_fit = r.fit.ratio_validate = 1.01;
    e.ranking = {r};
    e.adopted = {r.effect};
    e.final_fit = r.fit;
    e.nominal_ratio_validate = 5.25;
    e.base_ratio_validate = 4.75;
    e.final_ratio_validate = e.final_ratio_fit = 1.01;
    e.ladder = {{"", 6, 5.25}, {"parameters", 5, 4.75}, {"side-pull at A", 1.01, 1.01}};
    e.confusable = {{"side-pull", "sensor-gain", "slow roll at 5 Hz"}};
    Candidate c;
    c.effect = r.effect;
    c.ratio_validate = 1.02;
    e.screened.assign(20, c);
    e.warnings = {"side-pull@A.stiffness is strongly correlated"};
    return e;
  }

  static std::string Read(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }

  static std::string ExplainHtml(const Explanation& e) {
    const TemporaryFolder folder;
    WriteExplainReport(*case_, e, folder.File("explain.html"));
    return Read(folder.File("explain.html"));
  }

  static Case* case_;
  static CaseModel* model_;
  static Comparison* before_;
};
Case* DiscoveryReport::case_ = nullptr;
CaseModel* DiscoveryReport::model_ = nullptr;
Comparison* DiscoveryReport::before_ = nullptr;

void ExpectSections(const std::string& html, const std::vector<std::string>& sections) {
  for (const std::string& s : sections) EXPECT_THAT(html, HasSubstr(">" + s + "</h")) << s;
}

// Our markup alone: the plotting library's source names addresses in comments.
void ExpectSelfContained(const std::string& html) {
  EXPECT_GT(html.size(), 1'000'000u) << "the plotting library is inside";
  for (const char* outside : {"<script src", "<link", "<img"})
    EXPECT_THAT(html, Not(HasSubstr(outside)));
}

TEST_F(DiscoveryReport, CompareHasEveryPicture) {
  const TemporaryFolder folder;
  WriteCompareReport(*model_, *before_, folder.File("c.html"));
  const std::string html = Read(folder.File("c.html"));
  ExpectSelfContained(html);
  ExpectSections(html, {"Errors by record and channel", "Errors by block",
                        "Dependence of the error", "record-1: multisine", "record-2: spinning"});
  for (const char* words :
       {"Order tracks", "Response to the injected force", "The worst channels in time",
        "Spectrum of that error", "Whiteness of the error", "bands of frequency", "4.50",
        "nothing was &lt;left&gt; out"})
    EXPECT_THAT(html, HasSubstr(words));
  EXPECT_THAT(html, Not(HasSubstr("folder/record-1.h5:"))) << "words name records, not paths";
}

TEST_F(DiscoveryReport, ExplainTeaches) {
  const std::string html = ExplainHtml(Found());
  ExpectSelfContained(html);
  ExpectSections(
      html, {"Verdict", "Error after each step", "Errors of the model of the rig file",
             "Ranked candidates", "Screening of all effects", "Evidence for the accepted effect",
             "Penalty of the accepted effect", "Residual", "Recommended next steps", "Warnings"});
  for (const char* words :
       {"Identified: side-pull at A", "5.25 times the noise", "97.0 %", "20.00 ± 0.30\u00a0kN/m",
        "slow roll at 5 Hz", "Signatures", "ambrig adopt folder/case.toml side-pull --target A",
        "strongly correlated"})
    EXPECT_THAT(html, HasSubstr(words));
  EXPECT_THAT(html, HasSubstr(FindEffect("side-pull")->title));
  EXPECT_THAT(html, Not(HasSubstr("Unexplained residual</h")));
}

TEST_F(DiscoveryReport, ASetOfTwoNamesIsNoIdentification) {
  Explanation e = Found();
  e.set = {{"side-pull", "A", 0.5}, {"sensor-gain", "A.x", 0.48}};
  const std::string html = ExplainHtml(e);
  EXPECT_THAT(html, HasSubstr("An effect is missing, and more than one effect remains: side-pull "
                              "at A (50 %) or sensor-gain at A.x (48 %)."));
  EXPECT_THAT(html, Not(HasSubstr("Identified")));
}

TEST_F(DiscoveryReport, UnknownGivesALawToPaste) {
  Explanation e = Found();
  e.verdict = ExplanationVerdict::kUnknown;
  e.remainder.kind = RemainderKind::kOther;
  e.adopted.clear();
  e.unexplained = {"rotor or sensor",
                   "plane B, worst at B.y",
                   "position on one side: contact at 40 degrees",
                   "what it looks like",
                   "force = { x = \"-k*max(0.766*x + 0.643*y - c, 0)\", y = \"0\" }",
                   {120.0}};
  const std::string html = ExplainHtml(e);
  ExpectSections(html,
                 {"Unexplained residual", "Change by the parameter fit", "Recommended next steps"});
  EXPECT_THAT(html, AllOf(HasSubstr("Something is missing"), HasSubstr("120\u00a0Hz")));
  e.remainder.kind = RemainderKind::kNone;
  EXPECT_THAT(ExplainHtml(e), HasSubstr("Only rig parameters that are not believed"));
}

TEST_F(DiscoveryReport, AdoptShowsBeforeAndAfter) {
  Case again = *case_;
  again.rig.effects.push_back(SidePull());
  CaseModel model(again);
  const Comparison after = Compare(model, Hypothesis::Base(again.rig), false);
  EXPECT_LT(after.ratio, before_->ratio);
  const TemporaryFolder folder;
  WriteAdoptReport(model, *before_, after, Found().ladder, folder.File("a.html"));
  const std::string html = Read(folder.File("a.html"));
  ExpectSelfContained(html);
  ExpectSections(html, {"Result", "Error after each step", "Effects of the new rig file",
                        "Before and after", "Residual"});
  EXPECT_THAT(html, HasSubstr("Channels with the largest improvement"));
}

TEST_F(DiscoveryReport, AnEffectThatDoesNotHelpIsSaidSo) {
  const TemporaryFolder folder;
  WriteAdoptReport(*model_, *before_, *before_, {{"", 2, 2}, {"windage at rig", 2, 2}},
                   folder.File("a.html"));
  EXPECT_THAT(Read(folder.File("a.html")), HasSubstr("windage at rig did not reduce the error"));
}

TEST_F(DiscoveryReport, WithoutUnseenRecordsNoErrorOfThemIsSaid) {
  Comparison all_fitted = *before_;
  all_fitted.ratio_validate = 0;
  const TemporaryFolder folder;
  WriteCompareReport(*model_, all_fitted, folder.File("c.html"));
  EXPECT_THAT(Read(folder.File("c.html")), HasSubstr("(none is kept unseen)"));
  WriteAdoptReport(*model_, all_fitted, all_fitted, {{"", 2, 2}}, folder.File("a.html"));
  EXPECT_THAT(Read(folder.File("a.html")), HasSubstr("after (no record is kept unseen)"));
}

// Nor does explain's page speak of records that were not used for fitting.
TEST_F(DiscoveryReport, ExplainOfRecordsThatWereAllFittedSaysSo) {
  Case all_fitted = *case_;
  for (CaseRecord& r : all_fitted.records) r.validate = false;
  Explanation e = Found();
  for (LadderStep& s : e.ladder) s.ratio_validate = s.ratio_fit;
  const TemporaryFolder folder;
  WriteExplainReport(all_fitted, e, folder.File("e.html"));
  const std::string html = Read(folder.File("e.html"));
  EXPECT_THAT(html, HasSubstr("All records were fitted, none was kept back to judge by"));
  EXPECT_THAT(html, HasSubstr("all, with it"));
  for (const char* untrue : {"unseen, with it", "change on unseen", "records, 0 unseen",
                             "\"unseen records\"", "not used for fitting"})
    EXPECT_THAT(html, Not(HasSubstr(untrue)));
}

// A model that equals the measurement but for a line of known size at order 1 gives that size.
TEST_F(DiscoveryReport, OrderTrackFindsTheSizeOfALine) {
  std::vector<double> predicted = model_->measured();
  for (const Target& t : model_->targets()) {
    if (ChannelName(*model_, t) != "A.x" || t.record != 1) continue;
    const Record& data = case_->records[1].data;
    for (std::size_t k = 0; k < t.count; ++k)
      predicted[t.first + k] -= 2e-6 * std::cos(1500 * data.TimeAt(k) + 0.3);
    const auto figure = OrderFigure(*model_, predicted, t);
    ASSERT_TRUE(figure);
    for (const auto& trace : figure->traces) {
      if (trace["name"] != "error, order 1") continue;
      // [um], least squares of an exact line
      for (const auto& y : trace["y"]) EXPECT_NEAR(y.get<double>(), 2, 1e-6);
      EXPECT_GE(trace["y"].size(), 2u);
    }
  }
}

}  // namespace
}  // namespace ambrig
