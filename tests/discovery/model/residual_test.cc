// Errors over the floor, rows that do not count, and the coordinates in which a fit moves.
#include "discovery/model/residual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "discovery/model/residual_force.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

TEST(Residual, IsTheErrorOverTheFloorOfTheRowsThatCount) {
  Case data = LinearCase::Make({2e-5, 4e-5}, 1, 3e-6);
  data.records[0].quality[0].ok[7] = 0;  // of A.x
  CaseModel model(data);
  for (Target& t : model.targets()) t.floor = t.channel == 0 ? 1e-6 : 2e-6;
  const std::vector<double> predicted(model.size(), 2e-5);
  const std::vector<double> r = Residual(model, predicted);
  const Target &x = model.targets()[0], &y = model.targets()[1];
  EXPECT_NEAR(r[x.first], 3, 1e-9);                // 23 µm against 20
  EXPECT_EQ(r[x.first + 7], 0);                    // not ok
  EXPECT_NEAR(r[y.first + 7], -10, 1e-9);          // 0 against 20 µm over 2 µm
  EXPECT_NEAR(TargetRatio(model, r, x), 3, 1e-9);  // 49 rows count, all alike
  const double n = LinearCase::kRows;
  EXPECT_NEAR(Ratio(model, r, Which::kFit), std::sqrt((9 * (n - 1) + 100 * n) / (2 * n - 1)), 1e-9);
  EXPECT_NEAR(Ratio(model, r, Which::kValidate), std::sqrt((23 * 23 + 100) / 2.0), 1e-9);
  EXPECT_NEAR(WorstRecordRatio(model, r), Ratio(model, r, Which::kValidate), 1e-12);
  EXPECT_NEAR(WorstRatio(model, r, Which::kFit), 10, 1e-9);
  EXPECT_NEAR(WorstRatio(model, r, Which::kAll), 23, 1e-9);
}

// A column that stands at 50 um and swings by 10 um to either side moves by 10 um rms.
TEST(CaseModel, TheFullScaleOfAColumnIsItsMovement) {
  Case c = LinearCase::Make({5e-5, 5e-5}, 1, 0);
  for (CaseRecord& r : c.records)
    for (std::size_t k = 0; k < LinearCase::kRows; ++k)
      r.data.channels[0].samples[k] += k % 2 == 0 ? 1e-5 : -1e-5;
  const CaseModel model(c);
  for (const Target& t : model.targets())
    EXPECT_NEAR(t.full_scale, t.channel == 0 ? 1e-5 : 0, 2e-7);
}

TEST(Residual, AKindOfRecordThatTheCaseHasNotLeavesNoError) {
  Case data = LinearCase::Make({2e-5}, 1, 3e-6);
  data.records[0].validate = false;
  const CaseModel model(data);
  const std::vector<double> r = Residual(model, std::vector<double>(model.size(), 0.0));
  EXPECT_EQ(Ratio(model, r, Which::kValidate), 0);
  EXPECT_GT(Ratio(model, r, Which::kFit), 0);
}

// Points of a response are few beside rows over time, whose floor is known to 1 % of its power:
// they count in full, the rows as 1e4 numbers. What rows leave below their floor does not make good
// what points leave.
TEST(Ratio, OfRowsAndPointsCountsEitherByWhatItTells) {
  ErrorSums sums;
  sums.square = 0.96 * 150000;
  sums.rows = 150000;
  EXPECT_NEAR(RatioOf(sums, 15), std::sqrt(0.96), 1e-12);
  sums.square_points = 9 * 120;
  sums.points = 120;
  EXPECT_NEAR(RatioOf(sums, 15), std::sqrt((1e4 + 9 * 120) / (1e4 + 120)), 1e-12);
  sums.rows = sums.square = 0;
  EXPECT_NEAR(RatioOf(sums, 15), 3, 1e-12);
}

TEST(Ratio, WithoutPointsAPointIsARow) {
  EXPECT_EQ(WorthOfPoint(CaseModel(LinearCase::Make({2e-5}, 1, 0))), 1);
}

TEST(Hypothesis, CoordinatesAndValuesAreInverse) {
  const LinearCase c({2e-5, 4e-5}, 1, 0);
  Hypothesis h = c.With({LinearCase::Gain(1.02), LinearCase::Offset(-2e-6)});
  EffectInstance eddy = MakeInstance(EffectNamed("eddy-currents"), "A");
  eddy.Set("cutoff", 3000);
  h.AddEffect(eddy);
  for (std::size_t k = 0; k < h.free.size(); ++k) {
    EXPECT_NEAR(h.Coordinate(k), 0, 1e-12) << h.free[k].path;
    for (const double u : {-0.2, 0.3}) {
      if ((u < 0 ? h.free[k].lo : h.free[k].hi) == h.free[k].start) continue;  // at a bound
      const double value = h.ValueAt(k, u);
      h.Set(k, value);
      EXPECT_NEAR(h.Coordinate(k), u, 1e-9) << h.free[k].path;
    }
  }
}

TEST(Hypothesis, ValuesStayInsideTheirBoundsAndReachTheRig) {
  const LinearCase c({2e-5, 4e-5}, 1, 0);
  Hypothesis h = c.With({LinearCase::Gain(1.02)});
  h.free[0].hi = 1.05;
  h.Set(0, 9);
  EXPECT_EQ(h.free[0].value, 1.05);
  EXPECT_EQ(h.rig.effects[0].Value("gain"), 1.05);
  EXPECT_EQ(h.ValueAt(0, 1e6), 1.05);
}

// A number with an sd is free, its prior is the drawing's value, and it starts at a calibration.
TEST(Hypothesis, RigParametersStartAtTheirCalibrationUnderThePriorOfTheDrawing) {
  RigParameters rig = LinearCase::Make({2e-5}, 1, 0).rig;
  const double mass = rig.rotor.mass;
  rig.tolerances = {{"rotor.mass", 0.01, mass + 0.02}, {"rotor.inertia_polar", 0, kRequired}};
  const Hypothesis h = Hypothesis::Base(rig);
  ASSERT_EQ(h.free.size(), 1u);  // the second has no sd
  EXPECT_EQ(h.free[0].start, mass);
  EXPECT_NEAR(h.Coordinate(0), 2, 1e-9);
  EXPECT_NEAR(h.rig.rotor.mass, mass + 0.02, 1e-12);
  EXPECT_NEAR(h.free[0].hi, mass + 0.08, 1e-12);  // eight sd
}

// Readings of free rotors count, those of clamped ones do not.
TEST(WorstMotionRatio, IsThatOfFreeRotors) {
  Case data = LinearCase::Make({2e-5, 4e-5, 6e-5}, 1, 0);
  std::vector<double> r;
  {
    const CaseModel clamped(data);
    r.assign(clamped.size(), 5);
    EXPECT_EQ(WorstMotionRatio(clamped, r), 0);
  }
  data.records[1].scenario.start = StartState::kLevitated;
  const CaseModel model(data);
  for (const Target& t : model.targets())
    for (std::size_t k = t.first; t.record == 1 && k < t.first + t.count; ++k)
      r[k] = t.channel == 0 ? 3 : 1;
  EXPECT_NEAR(WorstMotionRatio(model, r), std::sqrt(5.0), 1e-12);
}

// The kernel's gain at the cutoff is 1/√2; its derivatives are those of the smoothed signal.
TEST(Smooth, HasItsCutoffAndItsDerivatives) {
  const double rate = 20e3, cutoff = 200, w = 2 * kPi * cutoff;
  std::vector<double> y(4000);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = std::sin(w * static_cast<double>(k) / rate);
  const auto at = [&](int derivative, std::size_t k) {
    return Smooth(y, rate, cutoff, derivative)[k];
  };
  const std::size_t peak = 2025, zero = 2000;  // a quarter of the 100 samples of a period apart
  EXPECT_NEAR(at(0, peak), std::sqrt(0.5), 2e-3);
  EXPECT_NEAR(at(0, zero), 0, 1e-6);  // no phase
  EXPECT_NEAR(at(1, zero) / w, std::sqrt(0.5), 2e-3);
  EXPECT_NEAR(at(2, peak) / (w * w), -std::sqrt(0.5), 2e-3);
}

}  // namespace
}  // namespace ambrig
