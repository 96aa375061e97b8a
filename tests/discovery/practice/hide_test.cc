// Practice cases: deterministic, visible, within the drawing's tolerances, answers that read back.
#include "discovery/practice/hide.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "discovery/model/floor.h"
#include "discovery/model/residual.h"
#include "discovery/practice/case_score.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

RigParameters RigToHideIn() {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  std::erase_if(rig.bearings, [](const BearingParameters& b) { return b.kind->axial; });
  return rig;
}

class HideTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    request_ = new HideRequest{{{"sensor-gain", "B.y"}}, true, 5};
    hidden_ = new HiddenCase(Hide(RigToHideIn(), *request_));
  }
  static void TearDownTestSuite() {
    delete hidden_;
    delete request_;
  }
  static HideRequest* request_;
  static HiddenCase* hidden_;
};
HideRequest* HideTest::request_ = nullptr;
HiddenCase* HideTest::hidden_ = nullptr;

TEST_F(HideTest, SameSeedSameBitsAnotherSeedAnotherRig) {
  const HiddenCase again = Hide(RigToHideIn(), *request_);
  ASSERT_EQ(again.data.records.size(), hidden_->data.records.size());
  for (std::size_t r = 0; r < again.data.records.size(); ++r)
    for (std::size_t c = 0; c < again.data.records[r].data.channels.size(); ++c)
      ASSERT_EQ(again.data.records[r].data.channels[c].samples,
                hidden_->data.records[r].data.channels[c].samples);
  HideRequest other = *request_;
  other.seed = 6;
  const HiddenCase different = Hide(RigToHideIn(), other);
  EXPECT_NE(different.effects[0].values[0], hidden_->effects[0].values[0]);
  EXPECT_NE(different.truth.rotor.mass, hidden_->truth.rotor.mass);
}

TEST_F(HideTest, ParametersStayWithinTheirTolerances) {
  RigParameters nominal = RigToHideIn(), truth = hidden_->truth;
  int moved = 0;
  for (const Tolerance& t : nominal.tolerances) {
    const double shift = (*ParameterAt(truth, t.path) - *ParameterAt(nominal, t.path)) / t.sd;
    EXPECT_LE(std::abs(shift), 2.5 + 1e-9) << t.path;
    moved += shift != 0 ? 1 : 0;
  }
  EXPECT_GT(moved, 5);
}

// The true model leaves the noise and nothing else in every record; the rig file's model leaves
// more.
TEST_F(HideTest, OnlyTheTruthExplainsTheData) {
  CaseModel model(hidden_->data);
  Hypothesis truth, nominal = Hypothesis::Base(hidden_->data.rig);
  truth.rig = hidden_->truth;
  const NoiseFloor floor = FindFloor(model, truth);
  const double right = Ratio(model, Residual(model, floor.clean), Which::kAll);
  EXPECT_NEAR(right, 1.0, 0.03);
  EXPECT_GT(Ratio(model, Residual(model, *model.Predict(nominal)), Which::kAll), 1.5);
}

TEST_F(HideTest, AnswerReadsBack) {
  const std::string file = std::filesystem::temp_directory_path() /
                           ("ambrig_hide_" + std::to_string(::getpid()) + ".answer.toml");
  std::ofstream(file) << AnswerText(*hidden_, *request_, "practice");
  const Answer answer = ReadAnswers(file).at("practice");
  ASSERT_EQ(answer.slots.size(), 1U);
  EXPECT_EQ(answer.slots[0][0], (NamedEffect{"sensor-gain", "B.y"}));
  EXPECT_EQ(answer.verdicts, std::vector<std::string>{"effect"});
}

TEST(HideErrors, NameWhatIsWrong) {
  const auto message = [](HideRequest request) {
    try {
      Hide(RigToHideIn(), request);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(message({{{"sensor-gian", ""}}, true, 1}).find("sensor-gain"), std::string::npos);
  EXPECT_NE(message({{{"sensor-gain", "C.x"}}, true, 1}).find("A.x"), std::string::npos);
}

}  // namespace
}  // namespace ambrig
