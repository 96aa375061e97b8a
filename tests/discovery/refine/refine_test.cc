// The whole of `refine`: bursts of a held bearing whose iron is solid in one part and laminated in
// another. Its impedance is the sum of two diffusion laws with other thicknesses, which is neither
// the catalogue's law (one of them) nor made by the free shape's code.
#include "discovery/refine/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "discovery/experiment/examination.h"
#include "effects/diffusion_fit.h"
#include "rig/rig_file.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

constexpr double kSolid = 3e4, kLaminated = 4000, kPathLength = 2e-4;  // [Hz], [Hz], [m]

/// `gains`: errors of the current measurements of A, which the rig file does not hold.
Case MeasuredBursts(std::uint64_t seed, const std::vector<double>& gains = {}) {
  const std::string file =
      std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml";
  RigParameters rig = ReadRig(file);
  std::vector<ExaminationRecord> bursts;
  for (const ExaminationRecord& e : Examination(rig, seed))
    if (e.burst) bursts.push_back(e);
  Case c = EmptyCase(rig, bursts);
  c.file = "bursts";
  c.rig_file = file;
  Hypothesis truth = Hypothesis::Base(rig);
  truth.rig.bearings[0].coil_errors.current_gain = gains;
  truth.rig = WithEffect(truth.rig, "eddy-currents", "A", {{"cutoff", kSolid}});
  truth.rig =
      WithEffect(truth.rig, "eddy-currents", "A", {{"cutoff", kLaminated}, {"path", kPathLength}});
  // at the converters' rate a logger has the currents only
  for (CaseRecord& r : c.records)
    for (std::size_t k = 0; k < r.quality.size(); ++k)
      r.quality[k].use = r.data.channels[k].name.starts_with("A.i");
  const CaseModel model(c);
  for (std::size_t r = 0; r < c.records.size(); ++r) {
    const Record run = model.Simulated(truth, r, true, seed + r);
    for (Channel& ch : c.records[r].data.channels)
      ch.samples.assign(
          run.Find(ch.name)->samples.begin(),
          run.Find(ch.name)->samples.begin() + static_cast<std::ptrdiff_t>(ch.samples.size()));
  }
  return c;
}

TEST(Refine, FindsTheShapeAndWritesARigThatRuns) {
  const Case c = MeasuredBursts(11);
  const Refinement r = Refine(c, "eddy-currents", "A", "/tmp/refined.toml", {});
  EXPECT_EQ(r.effect, "eddy-currents");
  EXPECT_EQ(r.target, "A");
  EXPECT_EQ(r.shape.u_name, "frequency");
  EXPECT_EQ(r.curve.size(), r.shape.u.size());
  EXPECT_GT(r.ratio_before, 1.2);
  EXPECT_LT(r.ratio_after, 1.1);
  EXPECT_FALSE(r.any_unseen);
  ASSERT_LT(r.supported_lo, r.supported_hi);
  const double gap = c.rig.Find("A")->radial.gap;
  int compared = 0;
  for (const CurvePoint& p : r.curve) {
    if (p.u < 300 || p.u > 5e4 || p.support < kSupported || !p.visited) continue;
    const std::complex<double> s(0, 2 * kPi * p.u),
        law = Diffusion(s, kSolid, 0) + Diffusion(s, kLaminated, kPathLength / gap);
    // the simulated laws are sums of eight relaxations, within 3 % of gap and iron together
    EXPECT_NEAR(p.value, std::abs(law), 4 * p.sd + 0.03 * (1 + std::abs(law))) << p.u;
    ++compared;
  }
  EXPECT_GT(compared, 15);
  // Sizes that the records say less of than was known before are told, one as well as many.
  const bool idle = std::any_of(r.fit.influence.begin(), r.fit.influence.end(),
                                [](double i) { return i < 1; }),
             told = std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string&w) {
               return w.find("are not determined by these records") != std::string::npos;
             });
  EXPECT_EQ(told, idle);
  const RigParameters refined = ReadRigText(r.rig_text, "refined.toml");
  ASSERT_EQ(refined.effects.size(), c.rig.effects.size() + 1);
  EXPECT_EQ(refined.effects.back().name, "eddy-impedance");
  EXPECT_EQ(refined.effects.back().target, "A");
}

// Bursts tell the errors of single coils once the shape leaves nothing else: the new rig holds
// them. What all coils have in common, and in part what goes with the angle of the poles, may be
// parameters of the rig.
TEST(Refine, WritesTheErrorsOfTheCoils) {
  const std::vector<double> truth = {0.004, -0.003, 0.006, -0.005, 0, 0.002, -0.006, 0.003};
  const Case c = MeasuredBursts(11, truth);
  const Refinement r = Refine(c, "eddy-currents", "A", "/tmp/refined.toml", {});
  EXPECT_LT(r.ratio_after, 1.1);
  const RigParameters refined = ReadRigText(r.rig_text, "refined.toml");
  const std::vector<double>& found = refined.Find("A")->coil_errors.current_gain;
  ASSERT_EQ(found.size(), truth.size());
  double common = 0, left = 0, hidden = 0;
  for (std::size_t j = 0; j < truth.size(); ++j) common += (found[j] - truth[j]) / 8;
  EXPECT_LT(std::abs(common), 0.005);
  for (std::size_t j = 0; j < truth.size(); ++j) {
    left += std::pow(found[j] - common - truth[j], 2);
    hidden += truth[j] * truth[j];
  }
  EXPECT_LT(left, 0.2 * hidden);
}

TEST(Refine, NamesWhatCanBeRefined) {
  const Case c = MeasuredBursts(12);
  for (const auto& [effect, target, word] : {std::tuple{"loop-delay", "rig", "has no curve"},
                                             std::tuple{"eddy-curents", "", "did you mean"},
                                             std::tuple{"nix", "", "nix is no effect, allowed: "},
                                             std::tuple{"saturation", "C", "no such target"}})
    try {
      Refine(c, effect, target, "/tmp/refined.toml", {});
      ADD_FAILURE() << effect;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace ambrig
