// The one geometry of each stator against the closed forms of the stators, and that every user of
// it holds the same numbers.
#include "actuators/magnetics/stator_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

#include "actuators/magnetics/coil_network.h"
#include "core/math/constants.h"
#include "fdd/detectors/detection_feed.h"
#include "rig/rig_assembly.h"
#include "rig/rig_figures.h"
#include "rig/rig_file.h"
#include "tests/actuators/magnetics/template_stator.h"

namespace ambrig {
namespace {

RadialStatorParameters EightPoles() {
  RadialStatorParameters p;
  p.turns = 50;
  p.pole_area = 2.0372e-4;
  p.gap = 4e-4;
  p.leakage_inductance = 3.5e-4;
  p.resistance = 0.5;
  p.first_pole_angle_deg = 10;
  p.winding = "NNSSNSSN";
  return p;
}

RigParameters Rig(const std::string& folder) {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/" + folder + "/rig.toml");
}

// Force and inductance of RadialStator, which works with the parameters themselves, from the lanes.
TEST(StatorGeometry, GivesTheClosedFormsOfARadialStator) {
  const RadialStatorParameters p = EightPoles();
  const StatorGeometry g = GeometryOf(p);
  const Eigen::Vector2d r(7e-5, -4e-5);
  CoilVector i, P, m;
  i << 2.1, 0.4, 3.3, 1.9, 0.2, 2.7, 1.1, 0.6;
  for (int j = 0; j < kPoles; ++j) {
    const double gap = g.gap_offset[j] - r.x() * g.direction_x[j] - r.y() * g.direction_y[j];
    P[j] = 1 / g.reluctance.Value(gap);
    m[j] = g.n[j] * i[j];
  }
  const CoilVector phi = P.cwiseProduct((m.array() - P.dot(m) / P.sum()).matrix());
  Eigen::Vector2d f(0, 0);
  for (int j = 0; j < kPoles; ++j)
    f += 0.5 * g.reluctance.per_metre * phi[j] * phi[j] *
         Eigen::Vector2d(g.direction_x[j], g.direction_y[j]);
  const RadialStator stator(p);
  EXPECT_LT((f - stator.Force(r, i)).norm(), 1e-12 * f.norm());
  for (int j = 0; j < kPoles; ++j) {
    const double own = g.n[j] * g.n[j] * P[j] * (1 - P[j] / P.sum()) + g.leakage[j];
    EXPECT_NEAR(own, stator.Inductance(r)(j, j), 1e-12 * own);
  }
}

TEST(StatorGeometry, PolesStandAnEighthOfATurnApartFromTheFirstOne) {
  const StatorGeometry g = GeometryOf(EightPoles());
  const std::vector<double> angle = g.Angles();
  ASSERT_EQ(angle.size(), 8u);
  for (std::size_t j = 0; j < 8; ++j) {
    const double drawn = (10 + 45.0 * static_cast<double>(j)) * kPi / 180;
    EXPECT_NEAR(std::remainder(angle[j] - drawn, 2 * kPi), 0, 1e-14);
    EXPECT_NEAR(std::hypot(g.Directions()[j][0], g.Directions()[j][1]), 1, 1e-15);
  }
  const double sign[8] = {1, 1, -1, -1, 1, -1, -1, 1};
  for (int j = 0; j < 8; ++j) EXPECT_EQ(g.n[j], 50 * sign[j]);
}

// 2 N² P (c0 + v)² of a side: the difference of both sides over v is 4 mu0 N² A c0/g².
TEST(StatorGeometry, AThrustStatorPullsAlongTheAxisWithItsForceConstant) {
  const RigParameters rig = Rig("reference");
  const BearingParameters& z = *rig.Find("Z");
  const StatorGeometry g = GeometryOf(z.thrust);
  EXPECT_EQ(g.coupling, Coupling::kSides);
  ASSERT_EQ(g.coils, 4);
  const double c0 = 1.5, v = 0.3;
  double f = 0;
  for (int side = 0; side < 2; ++side) {
    const int j = 2 * side;
    const double mmf = (g.n[j] + g.n[j + 1]) * (side == 0 ? c0 + v : c0 - v);
    const double phi = mmf / g.reluctance.Value(g.gap_offset[j]);
    f += g.direction_x[j] * 0.5 * g.reluctance.per_metre * phi * phi;
  }
  EXPECT_NEAR(f, ForceConstant(z) * c0 * v, 1e-12 * f);
}

// L(g) = L_inf + L_0/(1 + g/g_c), and f = (1/2) i² L'.
TEST(StatorGeometry, AnOpposedMagnetHasItsInductance) {
  const RigParameters rig = Rig("mls2em");
  const OpposedStatorParameters& p = rig.bearings[0].opposed;
  const StatorGeometry g = GeometryOf(p);
  ASSERT_EQ(g.coils, static_cast<int>(p.coils));
  for (const double gap : {0.5 * p.gap, p.gap, 1.3 * p.gap})
    EXPECT_NEAR(g.n[0] * g.n[0] / g.reluctance.Value(gap) + g.leakage[0],
                p.inductance_far + p.inductance_near / (1 + gap / p.gap_constant),
                1e-13 * p.inductance_near);
  EXPECT_EQ(g.direction_x[0], 1);
  EXPECT_EQ(GeometryOf([&] {
              OpposedStatorParameters one = p;
              one.coils = 1;
              return one;
            }())
                .coils,
            1);
}

TEST(StatorGeometry, ANumberOfLettersThatIsNotThatOfThePolesIsTheCallersMistake) {
  RadialStatorParameters p = EightPoles();
  p.winding = "NSNSNSN";
  EXPECT_THROW(GeometryOf(p), std::logic_error);
}

// What holds where every coil has one of the poles, all alike, on one iron without magnets.
TEST(StatorGeometry, ACoilOnEachPoleIsAStatorPoleByPole) {
  const auto of = [](const std::function<void(StatorParameters&)>& change) {
    StatorParameters p = testing::TemplateStator("one-coil-per-pole", {90, 2e-4, 4e-4, 1e-3}, 6);
    p.first_pole_angle_deg = 0;
    p.winding = "NSNSNS";
    p.poles = PolesOf(p);
    p.pattern.clear();
    change(p);
    return PoleByPole(GeometryOf(p));
  };
  const auto g = of([](StatorParameters& p) { std::swap(p.poles[1], p.poles[4]); });
  ASSERT_TRUE(g);
  EXPECT_EQ(g->coils, 6);
  for (int j = 0; j < 6; ++j) {
    EXPECT_EQ(g->n[j], j % 2 == 0 ? 90 : -90);
    EXPECT_NEAR(g->direction_x[j], std::cos(j * kPi / 3), 1e-12) << j;
    EXPECT_NEAR(g->direction_y[j], std::sin(j * kPi / 3), 1e-12) << j;
  }
  EXPECT_DOUBLE_EQ(g->reluctance.per_metre, 1 / (kMu0 * 2e-4));
  EXPECT_FALSE(of([](StatorParameters& p) { p.poles[2].area *= 1.1; }));
  EXPECT_FALSE(of([](StatorParameters& p) { p.poles[2].gap *= 1.1; }));
  EXPECT_FALSE(of([](StatorParameters& p) { p.poles[2].cone_deg = 5; }));
  EXPECT_FALSE(of([](StatorParameters& p) { p.poles[2].plane = 2; }));
  EXPECT_FALSE(of([](StatorParameters& p) { p.poles[2].turns[0] = 20; }));
  EXPECT_FALSE(of([](StatorParameters& p) { p.poles[2].magnet = {100, 1e-3, 2e-4, 1.05}; }));
  EXPECT_FALSE(
      of([](StatorParameters& p) { p.poles.push_back(p.poles[2]), p.poles.back().turns.clear(); }));
  EXPECT_FALSE(
      PoleByPole(GeometryOf(testing::TemplateStator("series-pairs", {90, 2e-4, 4e-4, 1e-3}))));
  EXPECT_FALSE(PoleByPole(GeometryOf(EightPoles())));
}

bool SameBits(const Lane& a, const Lane& b, int coils) {
  for (int j = 0; j < coils; ++j)
    if (a[j] != b[j]) return false;
  return true;
}

// The plant without effects, the detector's model and the controller's map are one geometry.
TEST(StatorGeometry, IsThatOfThePlantOfTheDetectorAndOfTheController) {
  for (const char* folder : {"reference", "mls2em", "small_spindle"}) {
    RigParameters rig = Rig(folder);
    rig.effects.clear();
    rig.tolerances.clear();
    const Plant plant = BuildPlant(TrueRig(rig));
    for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
      const StatorLanes& lanes = plant.bearings[k].lanes;
      const LinkageModel model = LinkageModelOf(rig.bearings[k]);
      ASSERT_EQ(lanes.coils, model.coils) << folder;
      EXPECT_EQ(lanes.coupling, model.coupling);
      EXPECT_EQ(lanes.reluctance.per_metre, model.reluctance.per_metre);
      EXPECT_EQ(lanes.reluctance.offset, model.reluctance.offset);
      EXPECT_TRUE(SameBits(lanes.n, model.n, model.coils));
      EXPECT_TRUE(SameBits(lanes.leakage, model.leakage, model.coils));
      EXPECT_TRUE(SameBits(lanes.resistance, model.resistance, model.coils));
      EXPECT_TRUE(SameBits(lanes.direction_x, model.direction_x, model.coils));
      EXPECT_TRUE(SameBits(lanes.direction_y, model.direction_y, model.coils));
      EXPECT_TRUE(SameBits(lanes.gap_offset, model.gap_offset, model.coils));
      const auto directions = CoilDirections(rig.bearings[k]);
      for (int j = 0; j < model.coils; ++j)
        EXPECT_EQ(directions[static_cast<std::size_t>(j)],
                  (std::array<double, 2>{model.direction_x[j], model.direction_y[j]}));
    }
  }
}

}  // namespace
}  // namespace ambrig
