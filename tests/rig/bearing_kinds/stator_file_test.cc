// Stators of a rig file: what poles and templates become, and every mistake in one line.
#include <gmock/gmock.h>

#include <cmath>

#include "actuators/magnetics/stator_parameters.h"
#include "core/base/read_file.h"
#include "core/math/constants.h"
#include "rig/nominal_control.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"
#include "rig/rig_file.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

std::string TextOf(const std::string& name) {
  return ReadFile(AMBRIG_SOURCE_DIR "/examples/stators/" + name);
}

std::string MistakeOf(const std::string& text) {
  try {
    ReadRigText(text, "rig.toml");
  } catch (const InputError& e) {
    const std::string message = e.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "no mistake";
}

TEST(StatorFile, PolesOneByOneAreTheTemplate) {
  const RigParameters rig = ReadRigText(TextOf("e_core_and_thrust.toml"), "rig.toml");
  const BearingParameters& b = *rig.Find("A");
  const auto network = b.kind->stator(b).network;
  ASSERT_TRUE(network);
  StatorParameters p;
  p.pattern = "e-core";
  p.turns = 80;
  p.pole_area = 6e-5;
  p.gap = 3e-4;
  p.winding = "NS";
  const auto same = NetworkOf(p);
  ASSERT_EQ(network->poles(), 12);
  ASSERT_EQ(network->coils(), 4);
  EXPECT_LT((network->FluxAt({2e-5, 3e-5, 0}).phi - same->FluxAt({2e-5, 3e-5, 0}).phi).norm(),
            1e-15);
}

TEST(StatorFile, EffectsThatActOnNothingAreSaid) {
  const std::string said = MistakeOf(TextOf("series_pairs.toml") +
                                     "\n[[effect]]\nname = \"eddy-currents\"\ntarget = \"A\"\n");
  EXPECT_THAT(said, HasSubstr("effect[1].name = \"eddy-currents\": acts on no part of this rig"));
  EXPECT_THAT(said, HasSubstr("allowed: where `ambrig effects eddy-currents` says"));
}

TEST(StatorFile, MapOfEightIndependentPolesIsTheRadialBearings) {
  const std::string text = ReferenceRigText();
  const NominalRig radial(ReadRigText(text, "rig.toml")),
      stator(ReadRigText(Replaced(text, "kind = \"radial\"",
                                  "kind = \"stator\"\ntemplate = \"one-coil-per-pole\""),
                         "rig.toml"));
  const CurrentMap a = MakeBearingControl(radial, 0).map, b = MakeBearingControl(stator, 0).map;
  EXPECT_NEAR(a.k, b.k, 1e-12 * a.k);
  EXPECT_EQ(a.c0, b.c0);
  EXPECT_LT((a.W - b.W).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(LargestInductance(radial->bearings[0]), LargestInductance(stator->bearings[0]),
              1e-12);
}

TEST(StatorFile, BandwidthGivesTheGains) {
  const RigParameters rig = ReadRigText(TextOf("six_poles.toml"), "rig.toml");
  // Six poles, one of them driven: its gap and the five others in parallel.
  const double P = kMu0 * 1e-4 / 3e-4, L = 60 * 60 * P * (1 - 1.0 / 6) + 2.8e-4;
  EXPECT_NEAR(rig.amplifier.kp, 2 * kPi * 1200 * L, 1e-9 * rig.amplifier.kp);
  EXPECT_NEAR(rig.amplifier.ki, 2 * kPi * 1200 * 0.8, 1e-9 * rig.amplifier.ki);
}

TEST(StatorFile, MistakesAreOneLine) {
  const std::string six = TextOf("six_poles.toml"), cores = TextOf("e_core_and_thrust.toml"),
                    magnet = TextOf("homopolar.toml");
  const auto with = [](const std::string& text, const std::string& from, const std::string& to) {
    return MistakeOf(Replaced(text, from, to));
  };
  EXPECT_THAT(with(six, "poles = 6", "poles = 9"), HasSubstr("poles = 9, allowed: 3 to 8"));
  EXPECT_THAT(with(six, "template = \"one-coil-per-pole\"", "template = \"six\""),
              HasSubstr("template = \"six\", allowed: series-pairs"));
  EXPECT_THAT(with(six, "template = \"one-coil-per-pole\"\npoles = 6", ""),
              HasSubstr("bearings.A.poles: is missing, allowed: poles = [{ angle_deg"));
  EXPECT_THAT(with(six, "bias_current = 1.5 ", "bias_current = 0.0 "), HasSubstr("bias_current"));
  EXPECT_THAT(with(six, "poles = 6", "poles = 6\nwinding = \"N\""),
              HasSubstr("do not move the force"));
  EXPECT_THAT(with(six, "poles = 6", "poles = 6\nwinding = \"NNNSSX\""),
              HasSubstr("winding = \"NNNSSX\", allowed: letters N and S"));
  EXPECT_THAT(with(six, "bandwidth = 1200.0", "bandwidth = 1200.0\nkp = 3.0"),
              HasSubstr("amplifier.kp: stands beside bandwidth"));
  EXPECT_THAT(with(six, "bandwidth = 1200.0", "bandwidth = 5000.0"),
              HasSubstr("bandwidth = 5000 Hz, allowed: at most 2500 Hz"));
  EXPECT_THAT(with(magnet, "quadrants = 4", "quadrants = 2"),
              HasSubstr("allowed: quadrants = 4 in [amplifier], or a bias current"));
  EXPECT_THAT(
      with(magnet, "bias = { mmf = 800.0, length = 4.0e-3, area = 6.0e-4, mu_r = 1.05 }\n", ""),
      HasSubstr("bias: is missing"));
  EXPECT_THAT(with(magnet, "mmf = 800.0", "mmf = 0.0"),
              HasSubstr("bearings.A.bias: has mmf = 0 A, allowed: any but 0"));
  EXPECT_THAT(with(magnet, "mmf = 800.0, ", ""),
              HasSubstr("bearings.A.bias: has no mmf, allowed: { mmf = A"));
  // Eight coils whose common current meets the magnet: little but leakage.
  EXPECT_THAT(with(magnet, "coils = \"pair\"", "coils = \"pole\""),
              HasSubstr("for bearing A has a pattern of currents with"));
  EXPECT_THAT(with(magnet, "coils = \"pair\"", "coils = \"paar\""),
              HasSubstr("coils = \"paar\", allowed: pair,axis,pole"));
  EXPECT_THAT(with(cores, "turns = { coil1 = 80 }", "turns = { coil9 = 80 }"),
              HasSubstr("coil9: names no coil, allowed: coil1 to coil8"));
  EXPECT_THAT(with(cores, "turns = { coil1 = 80 }", "turns = { coil1 = 60 }"),
              HasSubstr("pull the centred rotor with"));
  EXPECT_THAT(with(cores, "turns = { coil4 = -80 }", "turns = { coil5 = -80 }"),
              HasSubstr("have no turns of coil 4"));
  EXPECT_THAT(with(cores, "angle_deg = 0.0, area", "area"), HasSubstr("angle_deg: is missing"));
}

TEST(StatorFile, ConesNeedAFixedZ) {
  const std::string six =
      Replaced(TextOf("six_poles.toml"), "template = \"one-coil-per-pole\"\npoles = 6",
               "template = \"conical\"\ncone_deg = 10.0\npoles = 8");
  EXPECT_EQ(MistakeOf(six), "no mistake");
  const std::string thrust = TextOf("e_core_and_thrust.toml");
  EXPECT_THAT(MistakeOf(six + thrust.substr(thrust.find("[bearings.Z]"))),
              HasSubstr("has conical poles, which pull along the shaft too"));
}

}  // namespace
}  // namespace ambrig
