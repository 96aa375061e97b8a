// A resonance is estimated from forces and readings: from spectra of a known oscillator, and from
// records of a rig whose shaft bends otherwise than the uniform rod, where sensors and magnets lie
// on both sides of a node.
#include "discovery/search/resonance_estimate.h"

#include <gtest/gtest.h>

#include <random>

#include "core/math/constants.h"
#include "discovery/experiment/examination.h"
#include "discovery/model/record_rows.h"
#include "discovery/search/resonance_starts.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

RigParameters RigOf(const std::string& example) {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/" + example + "/rig.toml");
  rig.tolerances.clear();
  return rig;
}

EffectInstance BentShaft(const std::vector<std::pair<std::string, double>>& values) {
  EffectInstance mode = MakeInstance(EffectNamed("bending-mode"), "rig");
  for (const auto& [name, value] : values) mode.Set(name, value);
  return mode;
}

/// Both directions at one speed: random forces, and what an oscillator of these gains answers,
/// beside forces that are 4 % larger and 20 us later than measured on a shaft of 2 kg.
std::vector<FreeResponse> Oscillator(const ResonanceEstimate& truth, double speed) {
  std::mt19937 draw(7);
  std::normal_distribution<double> normal;
  std::vector<FreeResponse> out(2);
  const double w0 = 2 * kPi * truth.frequency;
  for (std::size_t side = 0; side < 2; ++side) {
    FreeResponse& r = out[side];
    r.direction = side == 0 ? 1 : -1;
    r.speed = speed;
    r.line = 15;
    std::vector<double> w;
    std::array<std::vector<Complex>, 2> force, missing;
    Complex ends[4];  // of the oscillator's and the shaft's states
    for (Complex& end : ends) end = {normal(draw), normal(draw)};
    for (double at = 150 - r.line; at < 9000 + r.line; at += r.line) {
      const Complex f[2] = {{normal(draw), normal(draw)}, {normal(draw), normal(draw)}};
      const Complex H = 1.0 / (w0 * w0 - at * at + r.direction * truth.gyro * speed * at +
                               Complex(0, 2 * truth.damping * w0 * at));
      const Complex own = ends[0] + Complex(0, at) * 0.003 * ends[1],
                    mass = ends[2] + Complex(0, at) * 0.003 * ends[3];
      w.push_back(at);
      for (std::size_t b = 0; b < 2; ++b) {
        const auto s = static_cast<Eigen::Index>(b);
        force[b].push_back(f[b]);
        missing[b].push_back(
            H * (truth.gains(s, 0) * (f[0] + own) + truth.gains(s, 1) * (f[1] + own)) -
            (0.04 - Complex(0, at * 20e-6)) * (f[0] + f[1]) / (2 * at * at) + mass / (at * at));
      }
    }
    for (std::size_t k = 1; k + 1 < w.size(); ++k) {
      r.w.push_back(w[k]);
      for (std::size_t b = 0; b < 2; ++b) {
        r.force[b].push_back({force[b][k - 1], force[b][k], force[b][k + 1]});
        r.missing[b].push_back(Windowed({missing[b][k - 1], missing[b][k], missing[b][k + 1]}));
        r.scale[b].push_back(1e-8);
      }
    }
  }
  return out;
}

TEST(ResonanceEstimate, TellsAnOscillatorBesideErrorsOfTheForces) {
  ResonanceEstimate truth;
  truth.frequency = 287.3;
  truth.damping = 0.012;
  truth.gyro = 0.17;
  truth.gains << 0.2, -0.3, -0.5, 0.75;
  const auto found = EstimateResonances(Oscillator(truth, 600), 3);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].frequency, truth.frequency, 0.5);
  EXPECT_NEAR(found[0].damping, truth.damping, 0.002);
  EXPECT_NEAR(found[0].gyro, truth.gyro, 0.01);
  EXPECT_LT((found[0].gains - truth.gains).norm(), 0.03 * truth.gains.norm());
  EXPECT_GT(found[0].share, 0.98);
}

// The ends of a record tell what is sharper than its lines, down to a tenth of one at half power.
TEST(ResonanceEstimate, TellsWhatIsSharperThanTheLinesOfTheRecords) {
  ResonanceEstimate truth;
  truth.frequency = 287.3;
  truth.gyro = -0.25;
  truth.gains << 0.2, -0.3, -0.5, 0.75;
  for (const double damping : {1e-3, 1e-5}) {
    truth.damping = damping;
    const auto found = EstimateResonances(Oscillator(truth, 600), 1);
    ASSERT_FALSE(found.empty());
    const double least = 0.1 * 15 / (2 * 2 * kPi * found[0].frequency);
    EXPECT_NEAR(found[0].damping, std::max(damping, least), 0.1 * least);
    EXPECT_NEAR(found[0].frequency, truth.frequency, 0.1);
    EXPECT_NEAR(found[0].gyro, truth.gyro, 0.005);
  }
}

TEST(ResonanceEstimate, NothingIsFoundWhereOnlyTheForcesAreWrong) {
  ResonanceEstimate none;
  none.frequency = 300;
  EXPECT_TRUE(EstimateResonances(Oscillator(none, 0), 3).empty());
  EXPECT_TRUE(EstimateResonances({}, 3).empty());
}

// A hum is a line that no force makes: the ends of the records explain it, and nothing else.
TEST(ResonanceEstimate, AToneOfAnotherOriginIsNone) {
  ResonanceEstimate none;
  none.frequency = 300;
  auto responses = Oscillator(none, 0);
  for (FreeResponse& r : responses)
    for (std::size_t k = 0; k < r.w.size(); ++k) {
      FreeResponse::Neighbours tone;
      for (std::size_t side = 0; side < 3; ++side)
        tone[side] = 1e-6 / (r.w[k] + (static_cast<double>(side) - 1) * r.line - 2 * kPi * 311.7);
      for (auto& missing : r.missing) missing[k] += Complex(0.6, 0.8) * r.line * Windowed(tone);
    }
  EXPECT_TRUE(EstimateResonances(responses, 3).empty());
}

// Of two bearings and their sensors a mode's gains are the products of its shape there; of a base
// they are all one over its mass, since it moves by the sum of both forces and all sensors move
// with it.
TEST(ResonanceGains, AreProductsOfTheShapeAndOneOverTheMass) {
  const RigParameters rig = RigOf("small_spindle");
  const EffectInstance bent =
      BentShaft({{"frequency", 300}, {"gain_a", 0.6}, {"gain_b", -0.4}, {"length", 0.8}});
  RigParameters with = rig;
  with.effects.push_back(bent);
  const Plant plant = BuildPlant(TrueRig(with));
  const BendingMode& mode = plant.rotor.modes().back();
  const Eigen::Matrix2d gains = ResonanceGains(rig, bent);
  for (Eigen::Index s = 0; s < 2; ++s)
    for (Eigen::Index b = 0; b < 2; ++b)
      EXPECT_NEAR(gains(s, b),
                  mode.Gain(rig.bearings[static_cast<std::size_t>(s)].sensor.z) *
                      mode.Gain(rig.bearings[static_cast<std::size_t>(b)].z),
                  1e-6);
  EffectInstance base = MakeInstance(EffectNamed("base-mode"), "rig");
  base.Set("mass", 25);
  const Eigen::Matrix2d even = ResonanceGains(rig, base);
  EXPECT_LT((even - Eigen::Matrix2d::Constant(1 / 25.0)).norm(), 1e-6);
}

// A foundation that is stiffer one way shows as two resonances: one start knows both.
TEST(ResonanceStarts, TakeTwoEstimatesForOneResonanceThatDiffersByDirection) {
  const RigParameters rig = RigOf("small_spindle");
  ResonanceEstimate along_x, along_y;
  along_x.frequency = 40;
  along_y.frequency = 50;
  for (ResonanceEstimate* e : {&along_x, &along_y}) {
    e->damping = 0.03;
    e->gains = Eigen::Matrix2d::Constant(1 / 20.0);
  }
  std::vector<double> ratios;
  for (const EffectInstance& start :
       ResonanceStarts(rig, MakeInstance(EffectNamed("base-mode"), "rig"), {along_x, along_y}))
    ratios.push_back(start.Value("ratio") * (start.Value("frequency") > 45 ? -1 : 1));
  std::ranges::sort(ratios);
  ASSERT_EQ(ratios.size(), 4U);
  EXPECT_NEAR(ratios[0], -1, 1e-12);
  EXPECT_NEAR(ratios[1], -0.8, 1e-12);
  EXPECT_NEAR(ratios[2], 1, 1e-12);
  EXPECT_NEAR(ratios[3], 1.25, 1e-12);
}

/// A case of the rig's two multisine records, at rest and turning, measured on `truth`.
Case MeasuredOn(const RigParameters& rig, const EffectInstance& truth) {
  std::vector<ExaminationRecord> records = Examination(rig, 5, {});
  records.resize(2);
  Case data = EmptyCase(rig, records);
  CaseModel empty(data);
  Hypothesis h = Hypothesis::Base(rig);
  if (!truth.IsNull()) h.AddEffect(truth);
  for (std::size_t r = 0; r < data.records.size(); ++r)
    data.records[r].data = AtRowsOf(data.records[r].data, empty.Simulated(h, r, true, 3));
  return data;
}

void SetNoiseOfSensors(CaseModel& model) {
  for (Target& t : model.targets()) t.floor = model.data().rig.bearings[0].sensor.noise;
}

TEST(FreeResponses, OfARigidShaftAgreeWithTheModel) {
  const RigParameters rig = RigOf("small_spindle");
  const Case data = MeasuredOn(rig, MakeInstance(EffectNamed("bending-mode"), "rig"));
  CaseModel model(data);
  SetNoiseOfSensors(model);
  const auto responses = FreeResponses(model, Hypothesis::Base(rig));
  ASSERT_EQ(responses.size(), 4u);  // two records, both directions
  for (const FreeResponse& r : responses)
    for (std::size_t s = 0; s < 2; ++s) {
      double sum = 0;
      for (std::size_t k = 0; k < r.w.size(); ++k)
        sum += std::norm(r.missing[s][k] / r.scale[s][k]);
      EXPECT_LT(sum / static_cast<double>(r.w.size()), 1.5) << r.direction << " " << r.speed;
    }
}

// Its ring lasts as long as the record, and no frequency of the signals is near: sharper than a
// line of the records.
TEST(ResonanceEstimate, OfRecordsTellsAModeSharperThanALine) {
  const RigParameters rig = RigOf("small_spindle");
  const EffectInstance truth = BentShaft({{"frequency", 175.3},
                                          {"damping", 0.0026},
                                          {"gain_a", 0.114},
                                          {"gain_b", -0.102},
                                          {"gyro", -0.27},
                                          {"length", 0.763}});
  const Case data = MeasuredOn(rig, truth);
  CaseModel model(data);
  SetNoiseOfSensors(model);
  const auto found = EstimateResonances(FreeResponses(model, Hypothesis::Base(rig)), 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].frequency, 175.3, 0.2);
  EXPECT_NEAR(found[0].damping, 0.0026, 5e-4);
  EXPECT_NEAR(found[0].gyro, -0.27, 0.02);
  const Eigen::Matrix2d wanted = ResonanceGains(rig, truth);
  EXPECT_LT((found[0].gains - wanted).norm(), 0.2 * wanted.norm()) << found[0].gains << "\n"
                                                                   << wanted;
}

TEST(ResonanceStarts, OfRecordsAreNearTheModeOfAnotherRod) {
  const RigParameters rig = RigOf("small_spindle");
  const EffectInstance truth = BentShaft({{"frequency", 327},
                                          {"damping", 0.011},
                                          {"gain_a", 0.32},
                                          {"gain_b", -0.39},
                                          {"gyro", 0.1},
                                          {"length", 0.8}});
  const Case data = MeasuredOn(rig, truth);
  CaseModel model(data);
  SetNoiseOfSensors(model);
  const Hypothesis h = Hypothesis::Base(rig);
  const auto starts = ResonanceStarts(rig, MakeInstance(EffectNamed("bending-mode"), "rig"),
                                      EstimateResonances(FreeResponses(model, h), 1));
  ASSERT_GE(starts.size(), 1u);
  EXPECT_NEAR(starts[0].Value("frequency"), 327, 8);
  EXPECT_NEAR(starts[0].Value("gyro"), 0.1, 0.05);
  EXPECT_NEAR(starts[0].Value("length"), 0.8, 0.08);
  // bearings near a node: what the forces make of the readings is told better than the gains one by
  // one
  const Eigen::Matrix2d found = ResonanceGains(rig, starts[0]), wanted = ResonanceGains(rig, truth);
  EXPECT_LT((found - wanted).norm(), 0.3 * wanted.norm()) << found << "\n" << wanted;
}

}  // namespace
}  // namespace ambrig
