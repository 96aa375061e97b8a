// What the screening simulates of an effect whose law has a shape beside its size.
#include "discovery/search/probes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "discovery/experiment/examination.h"
#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

// Thin laminations and thick ones hold the flux back in other bands: one shape would miss the
// other.
TEST(Probes, ALawIsTriedInTheMiddleAndAtTheEndOfWhatShapesIt) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  const Case c = EmptyCase(rig, Examination(rig, 5, {}));
  const CaseModel model(c, 12);
  for (const char* id : {"eddy-currents", "saturation"}) {
    const EffectDescription& d = EffectNamed(id);
    std::map<double, std::set<double>> sizes_of;  // by path
    for (const ProbeGroup& g : ProbesOf(d, "A", model, {}))
      for (const EffectInstance& e : g.probes) sizes_of[e.Value("path")].insert(e.values[0]);
    // of laminations none at all too: thick iron, the null of `path`
    const bool thick = std::string(id) == "eddy-currents";
    ASSERT_EQ(sizes_of.size(), thick ? 3U : 2U) << id;
    EXPECT_EQ(sizes_of.contains(0), thick);
    for (const auto& [path, sizes] : sizes_of)
      EXPECT_EQ(sizes.size(), 4U) << id << " path " << path;
    for (const EffectParameter& p : d.parameters) {
      if (p.name == "path") {
        EXPECT_EQ(sizes_of.rbegin()->first, p.typical_hi) << id;
      }
    }
  }
}

// Eddy currents of a tenth of the smallest usual size would otherwise promise to make everything
// worse (practice case 4 of seed 17).
TEST(Probes, TheWeakestOfWhatVanishesAtInfinityMayBeScaledToNothing) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  const Case c = EmptyCase(rig, Examination(rig, 5, {}));
  const CaseModel model(c, 12);
  const EffectDescription& d = EffectNamed("eddy-currents");
  for (const ProbeGroup& g : ProbesOf(d, "A", model, {})) {
    const bool weakest = g.probes[0].Value("cutoff") > 0.9 * d.parameters[0].typical_hi;
    EXPECT_EQ(g.least, weakest ? 0.01 : 0.5);
    EXPECT_EQ(g.most, 2);
    ASSERT_EQ(g.scaling.size(), weakest ? 1U : 0U);
    if (weakest) {
      EXPECT_EQ(g.scaling[0].second,
                -2);  // of half order: a tenth of the size at a hundred times the cutoff
    }
  }
}

// Fringing flux that pulls looks like a larger pole area, one that does not like nothing else: with
// the first alone an effect of 8.6 floors, of which the rig parameters had taken up most, was not
// among the candidates (practice case 12 of seed 5).
TEST(Probes, AShapeThatMayBeLeftOutIsTriedWithoutWhateverSwitchesItsLaw) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  const Case c = EmptyCase(rig, Examination(rig, 5, {}));
  const CaseModel model(c, 12);
  for (const auto& [id, shape] :
       {std::pair{"fringing", "face_pull"}, {"copper-heating", "shared"}}) {
    std::set<double> tried;
    for (const ProbeGroup& g : ProbesOf(EffectNamed(id), "A", model, {}))
      for (const EffectInstance& e : g.probes) tried.insert(e.Value(shape));
    EXPECT_EQ(tried.size(), 2U) << id;
    EXPECT_TRUE(tried.contains(0)) << id;
  }
}

// A bus with little capacitance follows every period, one with much the mean: of three shapes one
// is near.
TEST(Probes, WhatIsSwitchedFromAFiniteNullIsTriedAtBothEndsOfWhatShapesIt) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  const Case c = EmptyCase(rig, Examination(rig, 5, {}));
  const CaseModel model(c, 12);
  const std::tuple<const char*, const char*, const char*> shaped[] = {
      {"bus-impedance", "rig", "capacitance"},
      {"hysteresis", "A", "width"},
      {"copper-heating", "A", "time_constant"}};
  for (const auto& [id, target, shape] : shaped) {
    const EffectDescription& d = EffectNamed(id);
    std::set<double> tried;
    for (const ProbeGroup& g : ProbesOf(d, target, model, {})) {
      EXPECT_TRUE(g.linear) << id;
      for (const EffectInstance& e : g.probes) tried.insert(e.Value(shape));
    }
    ASSERT_EQ(tried.size(), 3U) << id;
    for (const EffectParameter& p : d.parameters) {
      if (p.name != shape) continue;
      EXPECT_EQ(*tried.begin(), p.typical_lo) << id;
      EXPECT_EQ(*tried.rbegin(), p.typical_hi) << id;
    }
  }
}

// A delay acts in whole switching periods: the first six are tried, each by its middle.
TEST(Probes, ADelayIsTriedInWholePeriods) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  const Case c = EmptyCase(rig, Examination(rig, 5, {}));
  const CaseModel model(c, 12);
  std::set<int> periods;
  for (const ProbeGroup& g : ProbesOf(EffectNamed("loop-delay"), "rig", model, {})) {
    const double periods_of = g.probes[0].Value("time") * rig.amplifier.switching_frequency;
    periods.insert(static_cast<int>(std::ceil(periods_of)));
    EXPECT_NEAR(std::ceil(periods_of) - periods_of, 0.5, 1e-9);
  }
  EXPECT_EQ(periods, std::set<int>({1, 2, 3, 4, 5, 6}));
}

// A resonance is sought with one damping; its frequencies are many enough.
TEST(Probes, AResonanceIsSoughtWithOneDamping) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  const Case c = EmptyCase(rig, Examination(rig, 5, {}));
  const CaseModel model(c, 12);
  for (const ProbeGroup& g : ProbesOf(EffectNamed("base-mode"), "rig", model, {}))
    for (const EffectInstance& e : g.probes) EXPECT_EQ(e.Value("damping"), 0.05);
}

// The middle of a usual range: of positive values by ratio, of negative ones half of the way.
TEST(Probes, AShapeOfNegativeValuesIsTriedInTheMiddle) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  const Case c = EmptyCase(rig, Examination(rig, 5, {}));
  const CaseModel model(c, 12);
  for (const auto& [lo, hi, middle] :
       {std::tuple{1e-5, 4e-5, 2e-5}, std::tuple{-4e-5, -2e-5, -3e-5}}) {
    EffectDescription d = EffectNamed("eddy-currents");
    for (EffectParameter& p : d.parameters) {
      if (p.name != "path") continue;
      p.lo = -1;
      p.typical_lo = lo;
      p.typical_hi = hi;
    }
    std::set<double> tried;
    for (const ProbeGroup& g : ProbesOf(d, "A", model, {}))
      for (const EffectInstance& e : g.probes) tried.insert(e.Value("path"));
    EXPECT_TRUE(std::any_of(tried.begin(), tried.end(), [middle = middle](double v) {
      return std::abs(v - middle) < 1e-12;
    })) << lo;
  }
}

}  // namespace
}  // namespace ambrig
