// What an adoption writes into a person's rig file: the numbers that were found, and nothing else.
#include <gmock/gmock.h>

#include <sstream>

#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "discovery/refine/adopt.h"
#include "rig/rig_file.h"
#include "rig/true_rig.h"

namespace ambrig {
namespace {

const std::string kFile = std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml";

const char* const kEffects =
    "\n# measured in May, with the cover on\n"
    "[[effect]]  # first\n"
    "name = \"unbalance\"\n"
    "target = \"A\"   # the long side\n"
    "parameters = { c = { value = 1.0e-5, sd = 1.0e-6 }, s = 2.0e-6 }  # kg m\n"
    "\n"
    "[[effect]]\n"
    "name = \"sensor-offset\"\n"
    "target = \"B.x\"\n"
    "parameters = { offset = 1.0e-6 } # m\n";

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

/// Lines of `after` that are not in `before` at the same place of its order.
std::vector<std::string> NewLines(const std::string& before, const std::string& after) {
  const std::vector<std::string> old = Lines(before);
  std::vector<std::string> out;
  std::size_t at = 0;
  for (const std::string& line : Lines(after)) {
    const auto found = std::find(old.begin() + static_cast<std::ptrdiff_t>(at), old.end(), line);
    if (found == old.end())
      out.push_back(line);
    else
      at = static_cast<std::size_t>(found - old.begin()) + 1;
  }
  return out;
}

/// The comments of a text, in order.
std::vector<std::string> Comments(const std::string& text) {
  std::vector<std::string> out;
  for (const std::string& line : Lines(text))
    if (const auto at = line.find('#'); at != std::string::npos) out.push_back(line.substr(at));
  return out;
}

class AdoptedRigTextTest : public ::testing::Test {
 protected:
  std::string text_ = ReadFile(kFile) + kEffects;
  RigParameters Read(const std::string& text) const { return ReadRigText(text, kFile); }
  static std::size_t Index(const Hypothesis& h, const std::string& path) {
    for (std::size_t k = 0; k < h.free.size(); ++k)
      if (h.free[k].path == path) return k;
    ADD_FAILURE() << path;
    return 0;
  }
};

TEST_F(AdoptedRigTextTest, AFittedNumberIsPutBesideItsValue) {
  Hypothesis h = Hypothesis::Base(Read(text_));
  for (FreeParameter& p : h.free) p.effect = p.effect < 0 && p.path == "rotor.mass" ? -1 : 99;
  h.free[Index(h, "rotor.mass")].value = 4.207;
  const std::string out = AdoptedRigText(text_, h, h.rig.effects);
  EXPECT_THAT(
      NewLines(text_, out),
      ::testing::ElementsAre("mass = { value = 4.2, sd = 0.01, fitted = 4.207 }            # kg"));
  EXPECT_EQ(TrueRig(Read(out))->rotor.mass, 4.207);
}

TEST_F(AdoptedRigTextTest, CommentsAndOrderStay) {
  Hypothesis h = Hypothesis::Base(Read(text_));
  for (std::size_t k = 0; k < h.free.size(); ++k) h.Set(k, h.free[k].value + 0.25 * h.free[k].step);
  const std::string once = AdoptedRigText(text_, h, h.rig.effects);
  EXPECT_EQ(Comments(once), Comments(text_));
  const RigParameters found = *TrueRig(Read(once));
  for (const FreeParameter& p : h.free)
    if (p.effect < 0) {
      EXPECT_NEAR(*ParameterAt(found, p.path), p.value, 1e-8 * std::abs(p.value)) << p.path;
    }
  // A second adoption of the same changes nothing.
  EXPECT_EQ(AdoptedRigText(once, h, h.rig.effects), once);
}

TEST_F(AdoptedRigTextTest, ABearingThatIsLikeAnotherGetsLinesOfItsOwn) {
  Hypothesis h = Hypothesis::Base(Read(text_));
  h.Set(Index(h, "bearings.B.gap"), 4.02e-4);
  const RigParameters found = *TrueRig(Read(AdoptedRigText(text_, h, h.rig.effects)));
  EXPECT_EQ(found.Find("B")->radial.gap, 4.02e-4);
  EXPECT_EQ(found.Find("A")->radial.gap, 4e-4);
}

TEST_F(AdoptedRigTextTest, FittedEffectsAreChangedInTheirPlace) {
  const Hypothesis h = Hypothesis::Base(Read(text_));
  std::vector<EffectInstance> effects = h.rig.effects;
  ASSERT_EQ(effects.size(), 2u);
  effects[0].values[0] = 1.25e-5;
  effects[0].sd[0] = 5e-7;
  effects[1].values[0] = 2e-6;
  effects[1].sd[0] = 1e-7;
  const std::string out = AdoptedRigText(text_, h, effects);
  EXPECT_EQ(Comments(out), Comments(text_));
  const RigParameters found = Read(out);
  ASSERT_EQ(found.effects.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(found.effects[k].values, effects[k].values);
    EXPECT_EQ(found.effects[k].sd, effects[k].sd);
  }
  EXPECT_NE(out.find("s = 2.0e-6 }  # kg m"), std::string::npos);
}

TEST_F(AdoptedRigTextTest, ErrorsOfCoilsBecomeALineOfTheirBearing) {
  Hypothesis h = Hypothesis::Base(Read(text_));
  for (FreeParameter& p : h.free) p.effect = 99;  // nothing else was fitted
  BearingParameters& b = h.rig.bearings[1];
  ASSERT_EQ(b.name, "B");
  b.coil_errors.current_gain = {0.00123456, -0.002, 0, 0, 0, 0, 0, 0.004};
  const std::string once = AdoptedRigText(text_, h, h.rig.effects);
  EXPECT_THAT(NewLines(text_, once),
              ::testing::ElementsAre(
                  "coil_errors = { current_gain = [0.001235, -0.002, 0, 0, 0, 0, 0, 0.004] }"));
  EXPECT_THAT(Read(once).Find("B")->coil_errors.current_gain,
              ::testing::ElementsAre(0.001235, -0.002, 0, 0, 0, 0, 0, 0.004));
  EXPECT_FALSE(Read(once).Find("A")->coil_errors.any());
  h.rig.bearings[1].coil_errors = Read(once).Find("B")->coil_errors;
  h.rig.bearings[1].coil_errors.edge.assign(8, 2e-8);
  const RigParameters both = Read(AdoptedRigText(once, h, h.rig.effects));
  EXPECT_EQ(both.Find("B")->coil_errors.edge, std::vector<double>(8, 2e-8));
  EXPECT_EQ(both.Find("B")->coil_errors.current_gain,
            Read(once).Find("B")->coil_errors.current_gain);
}

TEST_F(AdoptedRigTextTest, ListsOfErrorsThatSayTheSameStayAsWritten) {
  const std::string header = "[bearings.B]\n";
  std::string with = text_;
  with.insert(with.find(header) + header.size(),
              "coil_errors = { edge = [1.00e-8, 0,  # a comment\n  0, 0, 0, 0, 0, 0.0] }\n");
  Hypothesis h = Hypothesis::Base(Read(with));
  for (FreeParameter& p : h.free) p.effect = 99;
  EXPECT_EQ(AdoptedRigText(with, h, h.rig.effects), with);
}

TEST_F(AdoptedRigTextTest, AnEffectThatIsDroppedGoesAndANewOneComesLast) {
  const Hypothesis h = Hypothesis::Base(Read(text_));
  EffectInstance added = h.rig.effects[1];
  added.target = "A.y";
  added.sd[0] = 1e-7;
  const RigParameters found = Read(AdoptedRigText(text_, h, {h.rig.effects[1], added}));
  ASSERT_EQ(found.effects.size(), 2u);
  EXPECT_EQ(found.effects[0].target, "B.x");
  EXPECT_EQ(found.effects[1].target, "A.y");
  EXPECT_EQ(found.effects[1].sd[0], 1e-7);
  const std::string none = AdoptedRigText(text_, h, {});
  EXPECT_TRUE(Read(none).effects.empty());
  EXPECT_NE(none.find("# measured in May, with the cover on"), std::string::npos);
}

}  // namespace
}  // namespace ambrig
