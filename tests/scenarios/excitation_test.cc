// Commanded signals over time, against their definition, and what their tables refuse.
#include "scenarios/excitation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "core/base/errors.h"
#include "core/math/constants.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

/// One [[excitation]] on force at A.x from 0.1 s to 0.3 s of a scenario of 0.5 s.
Excitation Read(const std::string& more, const std::string& folder = ".") {
  const TomlTable root = TomlTable::FromText(
      "[[excitation]]\ntarget = \"A.x\"\nstart = 0.1\nstop = 0.3\n" + more, "s.toml");
  return ReadExcitation(root.Tables("excitation")[0], folder, 0.5);
}

std::string Message(const std::string& more, const std::string& folder = ".") {
  try {
    Read(more, folder);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no mistake";
}

TEST(Excitation, IsNothingOutsideItsTime) {
  for (const char* law :
       {"kind = \"step\"", "kind = \"ramp\"", "kind = \"sine\"\nfrequency = 7.0\nphase = 1.0",
        "kind = \"chirp\"\nf0 = 5.0\nf1 = 50.0\nphase = 1.0",
        "kind = \"multisine\"\nfrequencies = [5.0, 9.0]\nphases = [1.0, 2.0]"}) {
    const Excitation e = Read(std::string("amplitude = 2.0\n") + law);
    EXPECT_EQ(e.Value(0.0999), 0) << law;
    EXPECT_EQ(e.Value(0.3), 0) << law;  // half open
    EXPECT_EQ(e.Value(std::nan("")), 0) << law;
    double most = 0;
    for (int k = 0; k < 200; ++k) most = std::max(most, std::abs(e.Value(0.1 + 1e-3 * k)));
    EXPECT_GT(most, 0.5) << law;
  }
}

TEST(Excitation, StepsAndRampsRunOverTheirTime) {
  const Excitation step = Read("kind = \"step\"\namplitude = -3.0"),
                   ramp = Read("kind = \"ramp\"\namplitude = 4.0");
  EXPECT_EQ(step.Value(0.1), -3);
  EXPECT_EQ(step.Value(0.29), -3);
  EXPECT_EQ(ramp.Value(0.1), 0);
  EXPECT_NEAR(ramp.Value(0.2), 2, 1e-12);
  EXPECT_NEAR(ramp.Value(0.3 - 1e-9), 4, 1e-6);
}

// Time counts from the start, so that a shifted excitation is the same signal later.
TEST(Excitation, SinesBeginAtTheirStart) {
  const Excitation e = Read("kind = \"sine\"\namplitude = 2.0\nfrequency = 25.0\nphase = 0.5");
  EXPECT_NEAR(e.Value(0.1), 2 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(e.Value(0.1 + 1 / 25.0), e.Value(0.1), 1e-9);
  EXPECT_NEAR(e.Value(0.1 + 0.5 / 25.0), -e.Value(0.1), 1e-9);
}

TEST(Excitation, AMultisineIsTheSumOfItsLines) {
  const Excitation all = Read(
      "kind = \"multisine\"\namplitude = 1.5\nfrequencies = [20.0, 45.0]\nphases = [0.3, -1.0]");
  const Excitation one = Read("kind = \"sine\"\namplitude = 1.5\nfrequency = 20.0\nphase = 0.3"),
                   two = Read("kind = \"sine\"\namplitude = 1.5\nfrequency = 45.0\nphase = -1.0");
  for (const double t : {0.1, 0.137, 0.25, 0.2999})
    EXPECT_NEAR(all.Value(t), one.Value(t) + two.Value(t), 1e-12);
  EXPECT_EQ(Read("kind = \"multisine\"\namplitude = 1.0\nfrequencies = [20.0]").phases[0], 0);
}

// The momentary frequency is the derivative of the phase: f0 at the start, f1 at the end.
TEST(Excitation, AChirpSweepsFromOneFrequencyToTheOther) {
  const Excitation e = Read("kind = \"chirp\"\namplitude = 1.0\nf0 = 10.0\nf1 = 60.0\nphase = 0.0");
  int crossings = 0;
  for (int k = 0; k < 200000; ++k)
    crossings += (e.Value(0.1 + 1e-6 * k) < 0) != (e.Value(0.1 + 1e-6 * (k + 1)) < 0) ? 1 : 0;
  EXPECT_NEAR(crossings, 2 * 0.2 * 35, 1.5);                   // mean frequency 35 Hz over 0.2 s
  EXPECT_NEAR(e.Value(0.1 + 1e-5) / 1e-5, 2 * kPi * 10, 0.1);  // its slope at the start
}

class ExcitationSamples : public ::testing::Test {
 protected:
  std::string Folder() const { return folder_.File("."); }
  void Write(const std::string& text) const { std::ofstream(folder_.File("u.csv")) << text; }
  static constexpr const char* kLaw = "kind = \"samples\"\nfile = \"u.csv\"\nchannel = \"u\"\n";
  testing::TemporaryFolder folder_;
};

// Times of the file are scenario times; between samples the last one holds, after the end too.
TEST_F(ExcitationSamples, AreHeldScaledAndInSi) {
  Write("t [s],u [kN]\n0.1,0.001\n0.15,0.002\n0.2,-0.003\n");
  const Excitation e = Read(std::string(kLaw) + "amplitude = 2.0", Folder());
  EXPECT_NEAR(e.Value(0.1), 2, 1e-9);
  EXPECT_NEAR(e.Value(0.149), 2, 1e-9);
  EXPECT_NEAR(e.Value(0.15), 4, 1e-9);
  EXPECT_NEAR(e.Value(0.29), -6, 1e-9);
  EXPECT_EQ(e.Value(0.31), 0);
}

TEST_F(ExcitationSamples, MistakesNameFileColumnAndPlace) {
  EXPECT_THAT(Message(kLaw, Folder()), HasSubstr("u.csv: no such file"));
  Write("t [s],v [N]\n0,1\n0.1,2\n0.2,2\n");
  EXPECT_THAT(Message(kLaw, Folder()), HasSubstr("channel = \"u\" is not in"));
  Write("t [s],u [N]\n0,1\n0.1,nan\n0.2,2\n");
  EXPECT_THAT(Message(kLaw, Folder()), HasSubstr("has no number at 0.1 s"));
  Write("t [s],u [m]\n0,1\n0.1,2\n0.2,2\n");
  EXPECT_THAT(Message(kLaw, Folder()), HasSubstr("on port force"));
  Write("t [s],u [N]\n0,1\n0.1,2e9\n0.2,2\n");
  EXPECT_THAT(Message(kLaw, Folder()), HasSubstr("holds 2000000000 N, allowed"));
}

TEST(ExcitationMistakes, AreOneLineWithTheAllowedValues) {
  EXPECT_THAT(Message("kind = \"sine\"\namplitude = 1.0"),
              HasSubstr("s.toml:1: excitation[1].frequency"));
  EXPECT_THAT(Message("kind = \"square\"\namplitude = 1.0"),
              HasSubstr("allowed: multisine, sine, chirp, step, pulse, ramp, samples"));
  EXPECT_THAT(Message("kind = \"step\""), HasSubstr("excitation[1].amplitude"));
  EXPECT_THAT(Message("kind = \"step\"\namplitude = 1.0\nport = \"reference\"\ncolour = 1"),
              HasSubstr("colour"));
  EXPECT_THAT(
      Message("kind = \"step\"\namplitude = 1.5\nport = \"reference\""),
      HasSubstr("amplitude = 1.5 m, allowed -1 to 1 m (amplitude of a reference position)"));
  EXPECT_THAT(Message("kind = \"multisine\"\namplitude = 1.0\nfrequencies = []"),
              HasSubstr("at least one frequency"));
  EXPECT_THAT(
      Message("kind = \"multisine\"\namplitude = 1.0\nfrequencies = [1.0, 2.0]\nphases = [0.0]"),
      HasSubstr("phases: has 1 entry, allowed: 2 as in frequencies"));
  EXPECT_THAT(Message("kind = \"sine\"\namplitude = 1.0\nfrequency = -5.0"),
              HasSubstr("frequency = -5 Hz"));
}

}  // namespace
}  // namespace ambrig
