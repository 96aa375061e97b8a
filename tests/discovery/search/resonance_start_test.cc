// A resonance is found from a start beside its valley, in a loop that answers strongly: with its
// damping let loose at once such a fit ends at a broad mode far away that explains the most of the
// misfit.
#include <gtest/gtest.h>

#include <cmath>

#include "discovery/experiment/examination.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/screen.h"
#include "discovery/search/start_search.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "tests/discovery/search/resonance_case.h"

namespace ambrig {
namespace {

using testing::BaseOf;
using testing::Measure;
using testing::ResonanceStartTest;

std::vector<ProbeGroup> GridOf(const std::vector<double>& frequencies) {
  std::vector<ProbeGroup> grid;
  for (const double frequency : frequencies) {
    ProbeGroup g;
    g.linear = false;
    g.narrow = true;
    g.probes = {BaseOf(70, frequency, 0.05)};
    grid.push_back(g);
  }
  return grid;
}

/// The fit with an effect that was adopted and changes nothing.
FitResult BesideNothing(FitResult fit) {
  EffectInstance nothing = MakeInstance(EffectNamed("sensor-offset"), "A.x");
  nothing.Set("offset", 1e-12);
  fit.hypothesis.AddEffect(nothing);
  return fit;
}

TEST_F(ResonanceStartTest, DampingIsHeldUntilTheFrequencyIsFound) {
  const FitResult fit = FittedFrom(BaseOf(166, 39, 0.05));
  ASSERT_TRUE(fit.converged);
  const EffectInstance found = FittedEffect(fit, 0);
  EXPECT_NEAR(found.Value("frequency"), 35, 0.4);
  EXPECT_NEAR(found.Value("mass"), 90, 3);
  EXPECT_NEAR(found.Value("damping"), 0.02, 0.005);
}

// Of several starts the one that explains most when it is simulated goes first, whatever the linear
// step thought of it.
TEST_F(ResonanceStartTest, StartsAreJudgedByTheirSimulation) {
  CaseModel model(data_, 4);
  const FitResult base = Simulated(model);
  Candidate candidate;
  candidate.narrow = true;
  candidate.effect = BaseOf(400, 150, 0.05);  // the linear step's favourite
  candidate.other_starts = {BaseOf(200, 150, 0.05), BaseOf(300, 110, 0.05), BaseOf(150, 110, 0.05),
                            BaseOf(180, 33, 0.05), BaseOf(90, 33, 0.05)};
  const FitResult fit = FitBriefly(model, base, candidate, 1e5);
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(FittedEffect(fit, 0).Value("frequency"), 35, 0.4);
}

// Where a start that the records gave explains much, no frequency of a grid is simulated; else all
// are.
TEST_F(ResonanceStartTest, AnEstimateThatExplainsMuchSparesTheGrid) {
  CaseModel model(data_, 4);
  const FitResult base = Simulated(model);
  const std::vector<ProbeGroup> grid = GridOf({33.0, 70.0, 120.0});
  const StartSearch search(model, base, 1e5);
  const auto runs_of = [&](const EffectInstance& estimated) {
    const long before = model.runs;
    const std::vector<ProbeGroup> starts = ScanStarts(search, grid, {estimated});
    EXPECT_FALSE(starts.empty());
    EXPECT_NEAR(starts[0].probes[0].Value("frequency"), 35, 2.5);
    return model.runs - before;
  };
  const long near = runs_of(BaseOf(90, 35, 0.02)), far = runs_of(BaseOf(90, 150, 0.02));
  // four sizes of the estimate; of the grid two sizes of every frequency and two more of the better
  // two
  EXPECT_EQ(far, near / 4 * (4 + 3 * 2 + 2 * 2));
}

// Frequencies far apart and one damping: the valley is found by simulation in several sizes, and
// the climb ends beside the truth without a single sensitivity.
TEST_F(ResonanceStartTest, AScanAndAClimbEndBesideTheTruth) {
  CaseModel model(data_, 4);
  const FitResult base = Simulated(model);
  const std::vector<ProbeGroup> grid = GridOf({20.0, 26.0, 33.0, 43.0, 70.0, 120.0});
  const StartSearch search(model, base, 1e5);
  const std::vector<ProbeGroup> starts = ScanStarts(search, grid, {});
  ASSERT_FALSE(starts.empty());
  for (std::size_t k = 1; k < starts.size(); ++k)
    EXPECT_FALSE(SameValley(starts[0].probes[0], starts[k].probes[0]));
  std::vector<SimulatedStart> climbed;
  for (const ProbeGroup& g : starts) climbed.push_back({g.probes[0]});
  search.Simulate(climbed);
  double before = kInfinity;
  for (const SimulatedStart& s : climbed) {
    EXPECT_LT(s.score, search.here());
    before = std::min(before, s.score);
  }
  search.Climb(climbed);
  ASSERT_EQ(climbed.size(), starts.size());
  EXPECT_TRUE(std::is_sorted(climbed.begin(), climbed.end(),
                             [](const auto& a, const auto& b) { return a.score < b.score; }));
  const SimulatedStart& best = climbed[0];
  EXPECT_LE(best.score, before);
  EXPECT_NEAR(best.effect.Value("frequency"), 35, 2.5);
  EXPECT_NEAR(std::log(best.effect.Value("mass") / 90), 0, 0.35);
}

// Beside an effect that was adopted a start has to explain a tenth of what is left; alone any gain
// is pursued.
TEST_F(ResonanceStartTest, BesideAnEffectAStartHasToExplainAPart) {
  CaseModel model(data_, 4);
  const FitResult base = Simulated(model);
  const FitResult beside = BesideNothing(base);
  const StartSearch alone(model, base, 1e5), second(model, beside, 1e5);
  std::vector<SimulatedStart> starts = {{BaseOf(90, 35, 0.02)}};
  alone.Simulate(starts);
  EXPECT_GT(starts[0].share, 0.99);  // the truth
  EXPECT_TRUE(alone.Explains(starts[0]));
  EXPECT_TRUE(second.Explains(starts[0]));
  for (const double share : {0.05, 0.15}) {
    const SimulatedStart gains = {starts[0].effect, alone.here() - 5, share};
    EXPECT_TRUE(alone.Explains(gains));
    EXPECT_EQ(second.Explains({starts[0].effect, second.here() - 5, share}), share > 0.1);
  }
  EXPECT_FALSE(alone.Explains({starts[0].effect, alone.here() - 3, 0.5}));
}

// What an adopted law leaves in detail is not worth as many climbs: the two best starts find the
// truth.
TEST_F(ResonanceStartTest, BesideAnEffectFewerStartsAreClimbed) {
  Candidate candidate;
  candidate.narrow = true;
  candidate.effect = BaseOf(400, 150, 0.05);
  candidate.other_starts = {BaseOf(300, 110, 0.05), BaseOf(150, 75, 0.05), BaseOf(150, 55, 0.05),
                            BaseOf(200, 45, 0.05)};
  long runs[2] = {};
  for (const bool beside : {false, true}) {
    CaseModel model(data_, 4);
    FitResult now = Simulated(model);
    if (beside) {
      now = BesideNothing(now);
      std::erase_if(now.hypothesis.free, [](const FreeParameter& p) { return p.effect >= 0; });
    }
    const long start = model.runs;
    const FitResult fit = FitBriefly(model, now, candidate, 1e5);
    runs[beside ? 1 : 0] = model.runs - start;
    ASSERT_TRUE(fit.converged);
    EXPECT_NEAR(FittedEffect(fit, beside ? 1 : 0).Value("frequency"), 35, 0.4);
  }
  EXPECT_LT(runs[1], runs[0]);
}

// Effects that were found hide no mode from an estimate: beside them a start that explains nothing
// ends the search.
TEST_F(ResonanceStartTest, BesideAnEffectEstimatesAreEnough) {
  CaseModel model(data_, 4);
  const FitResult beside = BesideNothing(Simulated(model));
  const StartSearch search(model, beside, 1e5);
  const long before = model.runs;
  EXPECT_TRUE(ScanStarts(search, GridOf({33.0, 70.0, 120.0}), {BaseOf(2000, 400, 0.02)}).empty());
  EXPECT_EQ(model.runs - before, 4);
  EXPECT_FALSE(ScanStarts(search, GridOf({33.0, 70.0, 120.0}), {}).empty());
}

// Friction in a contact that never comes: its ends change nothing, and the sizes between are not
// simulated.
TEST_F(ResonanceStartTest, ContactThatChangesNothingIsTriedAtItsEndsOnly) {
  CaseModel model(data_, 4);
  const FitResult base = Simulated(model);
  ProbeGroup g;
  g.linear = false;
  g.narrow = true;
  g.probes = {MakeInstance(EffectNamed("contact-friction"), "A")};
  const StartSearch search(model, base, 1e5);
  const long before = model.runs;
  EXPECT_TRUE(ScanStarts(search, {g}, {}).empty());
  EXPECT_EQ(model.runs - before, 2);
}

// A start that explains nearly all as it stands leaves little for other valleys.
TEST_F(ResonanceStartTest, AGoodStartSparesOthersTheirClimb) {
  long runs[2] = {};
  for (const bool good : {false, true}) {
    CaseModel model(data_, 4);
    const FitResult base = Simulated(model);
    Candidate candidate;
    candidate.narrow = true;
    candidate.effect = good ? BaseOf(90, 35.2, 0.02) : BaseOf(200, 45, 0.05);
    candidate.other_starts = {BaseOf(400, 150, 0.05), BaseOf(300, 110, 0.05), BaseOf(150, 75, 0.05),
                              BaseOf(150, 55, 0.05)};
    const long start = model.runs;
    const FitResult fit = FitBriefly(model, base, candidate, 1e5);
    runs[good ? 1 : 0] = model.runs - start;
    ASSERT_TRUE(fit.converged);
    EXPECT_NEAR(FittedEffect(fit, 0).Value("frequency"), 35, 0.4);
  }
  EXPECT_LT(2 * runs[1], runs[0]);
}

// Where another effect explains what moves, no resonance is simulated; where none does, it is.
TEST_F(ResonanceStartTest, IsSoughtWhereOtherEffectsLeaveTheMotionOpen) {
  EffectInstance gain = MakeInstance(EffectNamed("sensor-gain"), "A.x");
  gain.Set("gain", 1 + std::sqrt(0.01 * 0.2));  // its probe: the linear step is exact there
  for (const bool resonance : {false, true}) {
    Case c = data_;
    if (!resonance) Measure(c, gain);
    CaseModel model(c, 8);
    FitResult base = Simulated(model);
    base.jacobian = Eigen::MatrixXd(static_cast<Eigen::Index>(model.size()), 0);
    bool sought = false;
    ScreenOptions options;
    options.effective_sample_size = 1e4;
    options.progress = [&](double, const std::string& text) {
      sought = sought || text == "resonances";
    };
    SignatureBank bank;
    Screen(model, base, ResidualPeaks(), options, bank);
    EXPECT_EQ(sought, resonance);
  }
}

// Sizes of either kind are one valley, other frequencies and other signs are not.
TEST(SameValley, IsOneFrequencyAndOnePatternOfSigns) {
  EXPECT_TRUE(SameValley(BaseOf(50, 35, 0.05), BaseOf(300, 36, 0.02)));
  EXPECT_FALSE(SameValley(BaseOf(50, 35, 0.05), BaseOf(50, 40, 0.05)));
  EffectInstance a = MakeInstance(EffectNamed("bending-mode"), "rig"), b = a;
  a.Set("gain_a", 0.3);
  a.Set("gain_b", 0.3);
  b.Set("gain_a", 0.1);
  b.Set("gain_b", -0.1);
  EXPECT_FALSE(SameValley(a, b));
  b.Set("gain_b", 0.2);
  EXPECT_TRUE(SameValley(a, b));
}

}  // namespace
}  // namespace ambrig
