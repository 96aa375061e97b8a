// What a point of a study is: its rig file, its draws, its limits, and what the journal keeps of
// it.
#include "design/point.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <tuple>

#include "core/base/errors.h"
#include "design/responses.h"
#include "design/study_journal.h"
#include "rig/rig_file.h"
#include "tests/cli/cli_run.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

DesignVariable Variable(std::vector<std::string> paths, double low, double high, bool log) {
  DesignVariable v;
  v.paths = std::move(paths);
  v.low = low;
  v.high = high;
  v.logarithmic = log;
  return v;
}

TEST(DesignVariable, TheUnitIntervalIsItsRange) {
  for (const bool log : {false, true}) {
    const DesignVariable v = Variable({"controller.kp"}, 2, 32, log);
    EXPECT_DOUBLE_EQ(v.FromUnit(0), 2);
    EXPECT_DOUBLE_EQ(v.FromUnit(1), 32);
    EXPECT_DOUBLE_EQ(v.FromUnit(0.5), log ? 8 : 17);
    for (const double u : {0.1, 0.35, 0.9}) EXPECT_NEAR(v.ToUnit(v.FromUnit(u)), u, 1e-12);
    EXPECT_EQ(v.FromUnit(-0.2), 2);  // a search may step over the edge
    EXPECT_EQ(v.FromUnit(1.3), 32);
  }
}

DesignCandidate Candidate() {
  DesignCandidate c;
  c.name = "pid";
  c.rig_file = "rig.toml";
  c.rig_text = ReferenceRigText();
  c.variables = {Variable({"controller.kp"}, 3e5, 6e5, false),
                 Variable({"bearings.A.turns", "bearings.Z.turns"}, 40, 60, false)};
  return c;
}

// Only the numbers named change; several paths of one variable change together.
TEST(RigOfPoint, PutsTheNumbersInPlace) {
  const RigParameters rig = RigOfPoint(Candidate(), {5.5e5, 44}),
                      before = ReadRigText(ReferenceRigText(), "rig.toml");
  EXPECT_EQ(rig.controller.pid.kp, 5.5e5);
  EXPECT_EQ(rig.Find("A")->radial.turns, 44);
  EXPECT_EQ(rig.Find("B")->radial.turns, 44);  // like A
  EXPECT_EQ(rig.Find("Z")->thrust.turns, 44);
  EXPECT_EQ(rig.controller.pid.kd, before.controller.pid.kd);
  EXPECT_EQ(rig.tolerances.size(), before.tolerances.size());
  EXPECT_THROW(RigOfPoint(Candidate(), {5.5e5}), std::logic_error);
}

// A draw moves every toleranced number by its sd times the deviate, inside its range; the drawing
// stays.
TEST(Drawn, MovesTheTrueValuesOnly) {
  RigParameters rig = ReadRigText(ReferenceRigText(), "rig.toml");
  std::vector<double> draw(rig.tolerances.size());
  for (std::size_t k = 0; k < draw.size(); ++k) draw[k] = k % 2 == 0 ? 1.5 : -2;
  const RigParameters drawn = Drawn(rig, draw);
  for (std::size_t k = 0; k < draw.size(); ++k) {
    const Tolerance& t = drawn.tolerances[k];
    const double nominal = *ParameterAt(rig, t.path);
    EXPECT_NEAR(t.true_value, nominal + draw[k] * t.sd, 1e-12 * std::abs(nominal)) << t.path;
    EXPECT_EQ(*ParameterAt(drawn, t.path), nominal) << t.path;
  }
  for (const Tolerance& t : Drawn(rig, {}).tolerances) EXPECT_TRUE(std::isnan(t.true_value));
  draw[0] = -1e9;  // of the mass
  EXPECT_EQ(rig.tolerances[0].path, "rotor.mass");
  EXPECT_GT(Drawn(rig, draw).tolerances[0].true_value, 0);
}

TEST(PlaneDistance, CountsFromTheFirstRow) {
  Record r;
  r.channels = {{"disk.r.x", "m", {1e-5, 4e-5, 1e-5}}, {"disk.r.y", "m", {2e-5, 6e-5, 2e-5}}};
  const auto distance = PlaneDistance(r, "disk");
  ASSERT_EQ(distance.size(), 3u);
  EXPECT_EQ(distance[0], 0);
  EXPECT_NEAR(distance[1], 5e-5, 1e-18);
  EXPECT_THROW(PlaneDistance(r, "other"), std::logic_error);
}

const FigureInfo* InfoOf(FigureKind kind) {
  for (const FigureInfo& f : FigureInfos())
    if (f.kind == kind) return &f;
  return nullptr;
}

Study TwoFigures() {
  Study s;
  s.file = "study.toml";
  s.fingerprint = "12";
  s.candidates = {{"a", "rig.toml", "", {}}, {"b", "rig.toml", "", {}}};
  s.figures = {{"peak sensitivity", InfoOf(FigureKind::kPeakSensitivity), 0, "", true, 3.0},
               {"noise force", InfoOf(FigureKind::kNoiseForce), 0, "", true, {}}};
  return s;
}

TEST(MeetsLimits, WantsEveryFigureFiniteAndBelowItsLimit) {
  const Study s = TwoFigures();
  EXPECT_TRUE(MeetsLimits(s, {3.0, 99}));
  EXPECT_FALSE(MeetsLimits(s, {3.001, 1}));
  EXPECT_FALSE(MeetsLimits(s, {1, kInfinity}));
  EXPECT_FALSE(MeetsLimits(s, {std::nan(""), 1}));
}

// Every figure that a study may name is described once.
TEST(FigureInfos, AreCompleteAndDistinct) {
  std::set<std::string_view> names;
  for (const FigureInfo& f : FigureInfos()) {
    EXPECT_TRUE(names.insert(f.name).second) << f.name;
    EXPECT_FALSE(f.doc.empty() || f.unit.empty()) << f.name;
    EXPECT_EQ(InfoOf(f.kind), &f);
  }
  EXPECT_EQ(names.size(), 14u);
}

StudyResult Points() {
  StudyResult r;
  r.scales = {2, 1};
  for (const auto& [candidate, a, b, feasible, front] : {std::tuple{0, 2.0, 3.0, true, true},
                                                         {0, 2.4, 1.1, true, true},
                                                         {0, 1.0, 9.0, true, true},
                                                         {1, 9.0, 9.0, false, false},
                                                         {1, 2.9, 5.0, true, false},
                                                         {1, 2.0, 6.0, true, false}}) {
    StudyPoint p;
    p.candidate = static_cast<std::size_t>(candidate);
    p.result.figures = {a, b};
    p.feasible = feasible;
    p.front = front;
    r.points.push_back(p);
  }
  return r;
}

// Least largest share of the first start: max(2/2, 3/1), max(1.2, 1.1), max(0.5, 9).
TEST(RepresentativeOf, IsTheCompromiseOfItsCandidate) {
  EXPECT_EQ(RepresentativeOf(TwoFigures(), Points(), 0), 1u);
  EXPECT_EQ(RepresentativeOf(TwoFigures(), Points(), 1), 4u);  // feasible, none on the front
  StudyResult none = Points();
  for (StudyPoint& p : none.points) p.feasible = p.front = false;
  EXPECT_EQ(RepresentativeOf(TwoFigures(), none, 1), 3u);  // its start
}

TEST(StudyJournal, FindsWhatItKeptAndRefusesAnotherStudy) {
  const testing::TemporaryFolder folder;
  Study s = TwoFigures();
  const Evaluation fine{{1.25, 3e-7}, ""}, unstable{{kInfinity, kInfinity}, "unstable at 0 rad/s"};
  {
    StudyJournal journal(folder.File("out"), s);
    EXPECT_FALSE(journal.Find(0, {0.1}));
    journal.Add(0, {0.1}, fine);
    journal.Add(1, {0.1, 1.0 / 3}, unstable);
  }
  {
    const StudyJournal journal(folder.File("out"), s);
    EXPECT_EQ(journal.size(), 2u);
    EXPECT_EQ(journal.damaged(), 0u);
    ASSERT_TRUE(journal.Find(0, {0.1}));
    EXPECT_THAT(journal.Find(0, {0.1})->figures, ElementsAre(1.25, 3e-7));
    EXPECT_FALSE(journal.Find(1, {0.1}));  // of the other candidate
    ASSERT_TRUE(journal.Find(1, {0.1, 1.0 / 3}));
    EXPECT_EQ(journal.Find(1, {0.1, 1.0 / 3})->note, "unstable at 0 rad/s");
    EXPECT_TRUE(std::isinf(journal.Find(1, {0.1, 1.0 / 3})->figures[0]));
  }
  s.fingerprint = "13";
  const std::string text =
      testing::ErrorText<InputError>([&] { StudyJournal(folder.File("out"), s); });
  EXPECT_THAT(text, HasSubstr("holds another study"));
}

}  // namespace
}  // namespace ambrig
