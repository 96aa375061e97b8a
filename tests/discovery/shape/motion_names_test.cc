// Forces of the motion whose law is of another form than the catalogue's: what the law leaves its free shape explains, and
// the name is told from those that only resemble it.
#include <gtest/gtest.h>

#include "core/math/noise.h"
#include "discovery/practice/examination.h"
#include "discovery/practice/laws/practice_law.h"
#include "discovery/shape/shape_names.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

constexpr double kReadingNoise = 1e-7, kMotionN = 2000;  // [m]

/// The rotor, running up, pushed at bearing A by three tones in each axis; its readings there count.
Case PushedCase() {
  RigParameters rig = ReferenceRig();
  rig.tolerances.clear();
  std::string text =
      "name = \"pushed\"\nrig = \"rig.toml\"\nduration = 0.3\nrecord_rate = 12500.0\nseed = 1\n"
      "noise = false\nfault_tolerance = false\n[start]\nstate = \"levitated\"\n[speed]\n"
      "profile = [[0.0, 150.0], [0.3, 300.0]]\n";
  for (const char* axis : {"x", "y"})
    text += std::string("[[excitation]]\ntarget = \"A.") + axis +
            "\"\nport = \"force\"\nkind = \"multisine\"\nstart = 0.02\nstop = 0.3\nfrequencies = " +
            (*axis == 'x' ? "[30.0, 55.0, 110.0]\nphases = [0.3, 1.9, 4.0]"
                          : "[37.0, 62.0, 125.0]\nphases = [2.2, 0.7, 5.1]") +
            "\namplitude = 6.0\n";
  return EmptyCase(rig, {{"pushed", text, false, false}});
}

/// The ranking of one round against a machine with `truth`, judged by the shapes of the laws.
std::vector<RankedEffect> JudgedRound(const EffectInstance& truth) {
  Case data = PushedCase();
  Hypothesis machine = Hypothesis::Base(data.rig);
  machine.rig.effects.push_back(truth);
  const Record run = CaseModel(data).Simulated(machine, 0, false, 1);
  for (std::size_t k = 0; k < data.records[0].data.channels.size(); ++k) {
    Channel& ch = data.records[0].data.channels[k];
    data.records[0].quality[k].use = ch.name == "A.x" || ch.name == "A.y";
    for (std::size_t i = 0; i < ch.samples.size(); ++i)
      ch.samples[i] = run.Find(ch.name)->samples[i] +
                      kReadingNoise * Normal(5, static_cast<std::uint32_t>(k), i);
  }
  CaseModel model(data);
  for (Target& t : model.targets()) t.floor = kReadingNoise;
  FitOptions options;
  options.effective_sample_size = kMotionN;
  const FitResult base = Fit(model, Hypothesis::Base(data.rig), options);
  SignatureBank bank;
  const RoundSetting setting = {model, model, bank, kMotionN, 3, [](double, const std::string&) {}};
  std::vector<RankedEffect> ranking = RankEffects(setting, base, 0).ranking;
  JudgeByShape(setting, base, 0, ranking);
  return ranking;
}

/// The name comes first, its law leaves more than noise and the law's shape at most `most`.
void ExpectNamedByItsShape(const EffectInstance& truth, const std::string& name, double most) {
  const std::vector<RankedEffect> ranking = JudgedRound(truth);
  const RankedEffect& best = ranking.at(0);
  EXPECT_EQ(Named(best.effect), name);
  EXPECT_GT(best.fit.ratio_fit, 1.2);
  ASSERT_TRUE(best.shaped);
  EXPECT_LT(best.RatioFit(), most);
}

// A cross-coupling that falls off with the orbit.
TEST(JudgeMotionByShape, ACrossCouplingOfTheOrbitKeepsItsName) {
  const std::string k = "(30000 / (1 + (x * x + y * y) / 9e-10))";
  ExpectNamedByItsShape(FormulaAt("A", {{"force.x", "-" + k + " * y"}, {"force.y", k + " * x"}}),
                        "cross-coupling at A", 1.05);
}

// A coupling with a backward second and a fourth order beside the second one.
TEST(JudgeMotionByShape, ACouplingOfManyOrdersKeepsItsName) {
  ExpectNamedByItsShape(
      FormulaAt("A", {{"force.x", "3*cos(2*theta+1) + 0.6*cos(2*theta) + 0.4*cos(4*theta)"},
                      {"force.y", "3*sin(2*theta+1) - 0.6*sin(2*theta) + 0.4*sin(4*theta)"}}),
      "coupling-misalignment at A", 1.03);
}

// A spring that takes hold beyond some play holds the shaft back: no motor does that, whatever its shape.
TEST(JudgeMotionByShape, APullThatHoldsTheShaftBackIsNotAskedForItsShape) {
  const std::string f =
      "(-60000 * max(sqrt(x*x + y*y + 1e-20) - 5e-6, 0) / sqrt(x*x + y*y + 1e-20))";
  for (const RankedEffect& r :
       JudgedRound(FormulaAt("A", {{"force.x", f + " * x"}, {"force.y", f + " * y"}})))
    if (r.effect.name == "side-pull") {
      EXPECT_FALSE(r.shaped);
    }
}

}  // namespace
}  // namespace ambrig
