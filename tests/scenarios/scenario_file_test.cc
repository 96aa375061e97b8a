// What a scenario file says arrives in the scenario; contradictions are refused.
#include <gmock/gmock.h>

#include <cmath>

#include "core/base/errors.h"
#include "scenarios/scenario.h"
#include "tests/actuators/magnetics/reference_lanes.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Scenario ReadWith(const std::string& more, const std::string& top = "") {
  return ReadScenarioText("duration = 0.5\n" + top + more, "folder/run.toml", ReferenceLanesRig());
}

std::string ScenarioMessage(const std::string& more, const std::string& top = "") {
  try {
    ReadWith(more, top);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no mistake";
}

TEST(ScenarioFile, DefaultsAreALevitatedRotorAtRestWithFaultTolerance) {
  const Scenario s = ReadWith("");
  EXPECT_EQ(s.name, "run");  // the file's name
  EXPECT_EQ(s.rig_file, "rig.toml");
  EXPECT_EQ(s.duration, 0.5);
  EXPECT_EQ(s.record_rate, ReferenceLanesRig().controller.rate);
  EXPECT_EQ(s.seed, 1u);
  EXPECT_TRUE(s.noise && s.fault_tolerant && s.stiffness_compensation);
  EXPECT_EQ(s.start, StartState::kLevitated);
  EXPECT_EQ(s.redistribution, "auto");
  EXPECT_EQ(s.current_transition, kDefaultCurrentTransition);
  EXPECT_TRUE(std::isinf(s.speed_free_from));
  EXPECT_EQ(s.speed.Speed(0.3), 0);
  EXPECT_FALSE(s.expect.any());
}

TEST(ScenarioFile, ClampsHoldTheRotorInsideItsGap) {
  const Scenario s = ReadWith(
      "[start]\nstate = \"clamped\"\nposition = { A = [1e-5, -2e-5], B = [3e-5], Z = 4e-5 }\n");
  EXPECT_EQ(s.start, StartState::kClamped);
  EXPECT_THAT(s.clamp.at("A"), ElementsAre(1e-5, -2e-5));
  EXPECT_THAT(s.clamp.at("B"), ElementsAre(3e-5, 0));
  EXPECT_THAT(s.clamp.at("Z"), ElementsAre(4e-5, 0));
  EXPECT_THAT(ScenarioMessage("[start]\nstate = \"clamped\"\nposition = { A = [3e-4, 3e-4] }\n"),
              HasSubstr("inside the gap of 0.0004 m"));
  EXPECT_THAT(ScenarioMessage("[start]\nposition = { A = [0.0, 0.0] }\n"),
              HasSubstr("only allowed with state = \"clamped\""));
  EXPECT_THAT(ScenarioMessage("[start]\nstate = \"clamped\"\nposition = { C = [0.0, 0.0] }\n"),
              HasSubstr("is no bearing, allowed: A, B, Z"));
}

TEST(ScenarioFile, ClampedStartsMayBeUnderCurrent) {
  const std::string clamped = "[start]\nstate = \"clamped\"\n";
  EXPECT_EQ(ReadWith(clamped + "current = { \"A.coil1\" = 2.0 }\n").start_current.at("A.coil1"), 2);
  EXPECT_THAT(ScenarioMessage("[start]\ncurrent = { \"A.coil1\" = 2.0 }\n"),
              HasSubstr("start.current: is only allowed with state = \"clamped\""));
  EXPECT_THAT(ScenarioMessage(clamped + "current = { \"A.coil9\" = 2.0 }\n"),
              HasSubstr("is no coil, allowed: those of the rig, \"A.coil1\" for example"));
  EXPECT_THAT(ScenarioMessage(clamped + "current = { \"A.coil1\" = -1.0 }\n"),
              HasSubstr("= -1 A, allowed: 0 to 10 A"));
}

TEST(ScenarioFile, SpeedsRunThroughTheirRows) {
  const Scenario s = ReadWith("[speed]\nprofile = [[0.0, 0.0], [0.2, 100.0]]\nfree_from = 0.3\n");
  EXPECT_NEAR(s.speed.Speed(0.1), 50, 1e-9);
  EXPECT_NEAR(s.speed.Speed(0.4), 100, 1e-9);
  EXPECT_NEAR(s.speed.Angle(0.2), 10, 1e-9);  // the area below the ramp
  EXPECT_EQ(s.speed_free_from, 0.3);
  EXPECT_THAT(ScenarioMessage("[speed]\nprofile = [[0.0, 1.0], [0.0, 2.0]]\n"),
              HasSubstr("goes back in time"));
  EXPECT_THAT(ScenarioMessage("[speed]\nprofile = [[0.0]]\n"), HasSubstr("row 1 has 1 entry"));
  EXPECT_THAT(ScenarioMessage("[speed]\n"), HasSubstr("speed.profile: is missing"));
}

TEST(ScenarioFile, LoadsActAtBearingsStationsOrPlaces) {
  const Scenario s = ReadWith(
      "[[load]]\nplane = \"B\"\nforce = [1.0, 2.0]\nstart = 0.1\n"
      "[[load]]\nz = 0.05\nforce = [0.0, 0.0, 3.0]\n"
      "[[load]]\nplane = \"Z\"\nforce = 4.0\nstop = 0.2\n");
  ASSERT_EQ(s.loads.size(), 3u);
  EXPECT_EQ(s.loads[0].z, ReferenceLanesRig().Find("B")->z);
  EXPECT_EQ(s.loads[0].fy, 2);
  EXPECT_EQ(s.loads[0].start, 0.1);
  EXPECT_EQ(s.loads[0].stop, 0.5);  // the duration
  EXPECT_EQ(s.loads[1].fz, 3);
  EXPECT_TRUE(s.loads[2].axial);
  EXPECT_EQ(s.loads[2].fz, 4);
  EXPECT_EQ(s.loads[2].fx, 0);
  EXPECT_THAT(ScenarioMessage("[[load]]\nforce = [1.0, 2.0]\n"),
              HasSubstr("either plane = \"A\" or z"));
  EXPECT_THAT(ScenarioMessage("[[load]]\nz = 2.0\nforce = [1.0, 2.0]\n"),
              HasSubstr("a place on the shaft"));
  EXPECT_THAT(
      ScenarioMessage("[[load]]\nplane = \"A\"\nforce = [1.0, 2.0]\nstart = 0.3\nstop = 0.2\n"),
      HasSubstr("later than start"));
  EXPECT_THAT(ScenarioMessage("[[load]]\nplane = \"A\"\nforce = []\n"), HasSubstr("force"));
}

// One number has no direction across the shaft, two have none along it.
TEST(ScenarioFile, FewNumbersOfALoadMeanWhatActsAtItsPlane) {
  for (const char* across : {"plane = \"A\"", "z = 0.05"})
    for (const char* one : {"-10.0", "[-10.0]"})
      EXPECT_THAT(ScenarioMessage(std::string("[[load]]\n") + across + "\nforce = " + one + "\n"),
                  HasSubstr("load[1].force: allowed: [fx, fy] or [fx, fy, fz] in N"))
          << across << one;
  EXPECT_THAT(
      ScenarioMessage("[[load]]\nplane = \"Z\"\nforce = [1.0, 2.0]\n"),
      HasSubstr("load[1].force: at a bearing along the shaft, allowed: fz or [fx, fy, fz]"));
  const Scenario s = ReadWith(
      "[[load]]\nplane = \"Z\"\nforce = [4.0]\n"
      "[[load]]\nplane = \"Z\"\nforce = [1.0, 2.0, 3.0]\n"
      "[[load]]\nplane = \"A\"\nforce = [1.0, 2.0, 3.0]\n"
      "[[load]]\nplane = \"A\"\nforce = [1.0, 2.0]\n");
  ASSERT_EQ(s.loads.size(), 4u);
  const double wanted[][3] = {{0, 0, 4}, {1, 2, 3}, {1, 2, 3}, {1, 2, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(s.loads[k].fx, wanted[k][0]) << k;
    EXPECT_EQ(s.loads[k].fy, wanted[k][1]) << k;
    EXPECT_EQ(s.loads[k].fz, wanted[k][2]) << k;
  }
}

TEST(ScenarioFile, ASagIsBelowTheBus) {
  const auto said = [](const char* volts) {
    return ScenarioMessage(
        std::string("[[fault]]\ntime = 0.1\nkind = \"bus-sag\"\nparameters = { voltage = ") +
        volts + " }\n");
  };
  for (const char* volts : {"60.0", "30.0"})  // a rise, nothing at all
    EXPECT_THAT(said(volts), HasSubstr(" V, allowed: 0 to below 30 V (during the sag")) << volts;
  EXPECT_EQ(said("29.9"), "no mistake");
  EXPECT_EQ(said("0.0"), "no mistake");
}

TEST(ScenarioFile, FaultsComeInOrderOfTime) {
  const Scenario s = ReadWith(
      "[[fault]]\ntime = 0.3\nkind = \"open\"\ntarget = \"A.coil1\"\n"
      "[[fault]]\ntime = 0.1\nkind = \"bus-sag\"\nparameters = { voltage = 20.0 }\n");
  ASSERT_EQ(s.faults.size(), 2u);
  EXPECT_EQ(s.faults[0].kind, "bus-sag");
  EXPECT_EQ(s.faults[0].target, "rig");
  EXPECT_EQ(s.faults[0].Get("voltage", 0), 20);
  EXPECT_EQ(s.faults[0].Get("duration", 7), 7);
  EXPECT_EQ(s.faults[1].target, "A.coil1");
  EXPECT_THAT(s.faults[1].where, HasSubstr("run.toml:2"));
}

TEST(ScenarioFile, TwoStatesOfOnePartAtOnceContradict) {
  const std::string open = "[[fault]]\ntime = 0.1\nkind = \"open\"\ntarget = \"A.coil1\"\n";
  EXPECT_THAT(ScenarioMessage(
                  open + "[[fault]]\ntime = 0.1\nkind = \"amplifier-off\"\ntarget = \"A.coil1\"\n"),
              HasSubstr("where open is set at the same instant"));
  // A coil and the sensor on it are two parts; another time or another coil is another state.
  EXPECT_EQ(ScenarioMessage(
                open + "[[fault]]\ntime = 0.1\nkind = \"current-sensor\"\ntarget = \"A.coil1\"\n"
                       "parameters = { gain = 1.2 }\n"),
            "no mistake");
  EXPECT_EQ(ScenarioMessage(
                open + "[[fault]]\ntime = 0.2\nkind = \"amplifier-off\"\ntarget = \"A.coil1\"\n"),
            "no mistake");
  EXPECT_EQ(ScenarioMessage(
                open + "[[fault]]\ntime = 0.1\nkind = \"amplifier-off\"\ntarget = \"A.coil2\"\n"),
            "no mistake");
}

TEST(ScenarioFile, FaultsNeedATimeAndATargetOfTheirKind) {
  EXPECT_THAT(ScenarioMessage("[[fault]]\ntime = 0.5\nkind = \"open\"\ntarget = \"A.coil1\"\n"),
              HasSubstr("0 to below the duration of 0.5 s"));
  EXPECT_THAT(ScenarioMessage("[[fault]]\ntime = 0.1\nkind = \"open\"\ntarget = \"A.x\"\n"),
              HasSubstr("\"A.x\" with kind open, allowed: A.coil1, A.coil2"));
  EXPECT_THAT(
      ScenarioMessage("[[fault]]\ntime = 0.1\nkind = \"position-sensor\"\ntarget = \"A.coil1\"\n"
                      "parameters = { lost = true }\n"),
      HasSubstr("allowed: A.x, A.y, B.x, B.y, z"));
}

TEST(ScenarioFile, ChangesOfTheControllerNeedOne) {
  EXPECT_THAT(ScenarioMessage("[[switch]]\ntime = 0.1\nto = \"soft\"\n"),
              HasSubstr("allowed: controllers of the rig: main"));
  EXPECT_EQ(ReadWith("[[switch]]\ntime = 0.1\nto = \"main\"\n").switches.size(), 1u);
  EXPECT_THAT(ScenarioMessage(
                  "[[switch]]\ntime = 0.1\nto = \"main\"\n[[switch]]\ntime = 0.1\nto = \"main\"\n"),
              HasSubstr("one change at one instant"));
}

TEST(ScenarioFile, ExpectationsAreWhatIsGiven) {
  const Scenario s =
      ReadWith("[expect]\ndetected_within = 0.002\nclassified = \"open\"\ntouchdown = false\n");
  EXPECT_TRUE(s.expect.any());
  EXPECT_EQ(s.expect.detected_within, 0.002);
  EXPECT_EQ(s.expect.classified, "open");
  EXPECT_EQ(s.expect.touchdown, false);
  EXPECT_FALSE(s.expect.drop);
  EXPECT_THAT(ScenarioMessage("[expect]\nclassified = \"burnt\"\n"), HasSubstr("allowed"));
}

TEST(ScenarioFile, RecordRatesAreThoseOfTheEngine) {
  EXPECT_EQ(ReadWith("", "record_rate = 5000.0\n").record_rate, 5000);
  EXPECT_EQ(ReadWith("", "record_rate = 450000.0\n").record_rate, 450e3);
  EXPECT_THAT(ScenarioMessage("", "record_rate = 7000.0\n"),
              HasSubstr("record_rate = 7000 Hz, allowed: the switching frequency 25000 Hz over"));
  EXPECT_THAT(ScenarioMessage("", "record_rate = 100000.0\n"),
              HasSubstr("a divisor of 18 samples"));
  EXPECT_THAT(ScenarioMessage("", "record_rate = 1.0\n"),
              HasSubstr("at least one in the duration"));
  EXPECT_THAT(ScenarioMessage("", "seed = -1\n"), HasSubstr("seed = -1, allowed: 0 or more"));
}

TEST(ScenarioFile, ExcitationsNeedATargetOfTheirPort) {
  EXPECT_THAT(
      ScenarioMessage("[[excitation]]\ntarget = \"A.coil1\"\nkind = \"step\"\namplitude = 1.0\n"),
      HasSubstr("\"A.coil1\" on port force, allowed: A.x, A.y, B.x, B.y, z"));
  EXPECT_THAT(ScenarioMessage("[[excitation]]\ntarget = \"A.x\"\nport = \"duty\"\nkind = \"step\"\n"
                              "amplitude = 0.1\n"),
              HasSubstr("on port duty, allowed: A.coil1"));
  EXPECT_EQ(ReadWith("[[excitation]]\ntarget = \"Z.coil4\"\nport = \"current\"\nkind = \"step\"\n"
                     "amplitude = 0.1\n")
                .excitations[0]
                .stop,
            0.5);
}

// Half the controller's rate of 12.5 kHz for an axis, half the switching frequency of 25 kHz for a
// coil: what is faster would come out as another, slower signal, and a multiple of the rate as none
// at all.
TEST(ScenarioFile, CommandsAboveHalfTheirRateAreRefused) {
  const auto on = [](const char* target, const char* signal) {
    return ScenarioMessage(std::string("[[excitation]]\namplitude = 1.0\n") + target + signal);
  };
  const char *axis = "target = \"A.x\"\nport = \"force\"\n",
             *coil = "target = \"A.coil1\"\nport = \"current\"\n";
  EXPECT_THAT(on(axis, "kind = \"sine\"\nfrequency = 12500.0\n"),
              HasSubstr("frequency = 12500 Hz, allowed: at most 6250 Hz, half the controller's"));
  EXPECT_THAT(on(axis, "kind = \"multisine\"\nfrequencies = [10.0, 6251.0]\n"),
              HasSubstr("frequencies = 6251 Hz, allowed: at most 6250 Hz"));
  EXPECT_THAT(on(axis, "kind = \"chirp\"\nf0 = 10.0\nf1 = 7000.0\n"),
              HasSubstr("f1 = 7000 Hz, allowed: at most 6250 Hz"));
  EXPECT_EQ(on(axis, "kind = \"chirp\"\nf0 = 10.0\nf1 = 6250.0\n"), "no mistake");
  EXPECT_EQ(on(coil, "kind = \"sine\"\nfrequency = 12000.0\n"), "no mistake");
  EXPECT_THAT(on(coil, "kind = \"sine\"\nfrequency = 13000.0\n"),
              HasSubstr("allowed: at most 12500 Hz, half the switching frequency (port current)"));
}

// A file of other times commands nothing at all, or one value throughout.
TEST(ScenarioFile, SamplesOfOtherTimesAreRefused) {
  const testing::TemporaryFolder folder;
  testing::WriteBytes(folder.File("late.csv"), "t,f\n5,1\n5.01,2\n5.02,3\n");
  const std::string samples =
      "[[excitation]]\ntarget = \"A.x\"\nkind = \"samples\"\nchannel = "
      "\"f\"\nfile = \"" +
      folder.File("late.csv") + "\"\n";
  EXPECT_THAT(
      ScenarioMessage(samples),
      HasSubstr("file: holds 5 s to 5.03 s, allowed: times of the excitation, 0 s to 0.5 s"));
}

}  // namespace
}  // namespace ambrig
