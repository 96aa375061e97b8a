/// Mistakes in a scenario file (tests/cli/mistake.h).
#include "tests/cli/mistake.h"

namespace ambrig {
namespace {

const Mistake kScenarioMistakes[] = {
    {"RootUnknown", "", "sed = 1", {"s.toml:5: sed", "unknown key", "did you mean seed?"}},
    {"RootSeed", "", "seed = -1", {"s.toml:5: seed = -1", "allowed: 0 or more"}},
    {"RootSeedType", "", "seed = 1.5", {"s.toml:5: seed = 1.5", "allowed: an integer"}},
    {"RootNoise", "", "noise = 1", {"s.toml:5: noise = 1", "allowed: true or false"}},
    {"RootDropLimit", "", "drop_limit = 0.0", {"s.toml:5: drop_limit = 0 s", "allowed"}},
    {"StartState",
     "",
     "[start]\nstate = \"flying\"",
     {"s.toml:6: start.state = \"flying\"", "allowed: levitated, resting, clamped"}},
    {"StartPosition",
     "",
     "[start]\nstate = \"levitated\"\nposition = { A = [0.0, 0.0] }",
     {"s.toml:7: start.position", "allowed with state = \"clamped\""}},
    {"StartOutsideTheGap",
     "",
     "[start]\nstate = \"clamped\"\nposition = { A = [5e-4, 0.0] }",
     {"s.toml:7: start.position.A = [0.0005, 0] m", "allowed: inside the gap of 0.0004 m"}},
    {"StartNoBearing",
     "",
     "[start]\nstate = \"clamped\"\nposition = { C = [0.0, 0.0] }",
     {"s.toml:7: start.position.C", "allowed: A, B, Z"}},
    {"StartNan",
     "",
     "[start]\nstate = \"clamped\"\nposition = { A = [nan, 0.0] }",
     {"s.toml:7: start.position.A", "entry 1 is not a finite number"}},
    {"SpeedBackInTime",
     "",
     "[speed]\nprofile = [[0.0, 1.0], [0.2, 2.0], [0.1, 3.0]]",
     {"s.toml:6: speed.profile", "goes back in time", "allowed: increasing t"}},
    {"SpeedTooFast",
     "",
     "[speed]\nprofile = [[0.0, 1e7]]",
     {"s.toml:6: speed.profile", "Omega = 10000000 rad/s", "allowed"}},
    {"SpeedRow",
     "",
     "[speed]\nprofile = [[0.0, 1.0, 2.0]]",
     {"s.toml:6: speed.profile", "row 1 has 3 entries", "allowed: [t, Omega]"}},
    {"SpeedNan",
     "",
     "[speed]\nprofile = [[0.0, nan]]",
     {"s.toml:6: speed.profile", "row 1 is not an array of finite numbers"}},
    {"SpeedMissing",
     "",
     "[speed]\nfree_from = 1.0",
     {"s.toml:5: speed.profile", "is missing", "allowed"}},
    {"SpeedFreeNan",
     "",
     "[speed]\nprofile = [[0.0, 1.0]]\nfree_from = nan",
     {"s.toml:7: speed.free_from = nan", "allowed"}},
    {"ExcitationPort",
     "",
     "[[excitation]]\ntarget = \"A.x\"\nport = \"voltage\"",
     {"s.toml:7: excitation[1].port = \"voltage\"", "allowed: force, reference, current, duty"}},
    {"ExcitationTarget",
     "",
     "[[excitation]]\ntarget = \"C.x\"\nkind = \"step\"\namplitude = 1.0",
     {"s.toml:6: excitation[1].target = \"C.x\" on port force", "allowed: A.x"}},
    {"ExcitationCoilOnForce",
     "",
     "[[excitation]]\ntarget = \"A.coil1\"\nkind = \"step\"\namplitude = 1.0",
     {"s.toml:6: excitation[1].target = \"A.coil1\"", "allowed: A.x"}},
    {"ExcitationKind",
     "",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"stepp\"\namplitude = 1.0",
     {"s.toml:7: excitation[1].kind = \"stepp\"", "did you mean step?"}},
    {"ExcitationTimes",
     "",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"step\"\namplitude = 1.0\nstart = 0.2\nstop = 0.1",
     {"s.toml:10: excitation[1].stop = 0.1", "allowed: later than start = 0.2"}},
    {"ExcitationAmplitude",
     "",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"step\"",
     {"s.toml:5: excitation[1].amplitude", "is missing", "allowed"}},
    {"ExcitationFrequencyInf",
     "",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"sine\"\namplitude = 1.0\nfrequency = inf",
     {"s.toml:9: excitation[1].frequency = inf", "allowed: a finite number"}},
    {"ExcitationPhases",
     "",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"multisine\"\namplitude = 1.0\nfrequencies = [1.0, "
     "2.0]\nphases = [0.0]",
     {"s.toml:10: excitation[1].phases", "has 1 entry, allowed: 2"}},
    {"ExcitationNoFile",
     "",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"samples\"\nfile = \"none.h5\"\nchannel = \"f\"",
     {"none.h5"}},
    {"LoadForce",
     "",
     "[[load]]\nplane = \"A\"\nforce = [1.0, 2.0, 3.0, 4.0]",
     {"s.toml:7: load[1].force", "allowed: [fx, fy]"}},
    {"LoadInf",
     "",
     "[[load]]\nplane = \"A\"\nforce = [inf, 0.0]",
     {"s.toml:7: load[1].force", "entry 1 is not a finite number"}},
    {"LoadPlane",
     "",
     "[[load]]\nplane = \"C\"\nforce = [1.0, 0.0]",
     {"s.toml:6: load[1].plane = \"C\"", "allowed: A, B, Z"}},
    {"LoadBoth",
     "",
     "[[load]]\nplane = \"A\"\nz = 0.1\nforce = [1.0, 0.0]",
     {"s.toml:6: load[1].plane", "allowed: either"}},
    {"LoadPlaceInf",
     "",
     "[[load]]\nz = inf\nforce = [1.0, 0.0]",
     {"s.toml:6: load[1].z = inf", "allowed"}},
    {"LoadTimes",
     "",
     "[[load]]\nplane = \"A\"\nforce = [1.0, 0.0]\nstart = 0.5",
     {"load[1].stop", "allowed: later than start"}},
    {"LoadNotATable", "", "load = 3", {"s.toml:5: load", "allowed: tables"}},
    {"FaultCoilNine",
     "",
     "[[fault]]\ntime = 0.005\ntarget = \"A.coil9\"\nkind = \"open\"",
     {"s.toml:7: fault[1].target = \"A.coil9\" with kind open", "allowed: A.coil1"}},
    {"FaultOnAnAxis",
     "",
     "[[fault]]\ntime = 0.005\ntarget = \"A.x\"\nkind = \"open\"",
     {"s.toml:7: fault[1].target = \"A.x\"", "allowed: A.coil1"}},
    {"FaultTime",
     "",
     "[[fault]]\ntime = 0.01\ntarget = \"A.coil1\"\nkind = \"open\"",
     {"s.toml:6: fault[1].time = 0.01 s", "allowed: 0 to below the duration of 0.01 s"}},
    {"FaultTimeNan",
     "",
     "[[fault]]\ntime = nan\ntarget = \"A.coil1\"\nkind = \"open\"",
     {"s.toml:6: fault[1].time = nan", "allowed"}},
    {"FaultKind",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"opn\"",
     {"s.toml:8: fault[1].kind = \"opn\"", "did you mean open?"}},
    {"FaultFraction",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"partial-short\"\nparameters = { "
     "fraction = 1.0 }",
     {"s.toml:9: fault[1].parameters.fraction = 1", "allowed: above 0 to below 1"}},
    {"FaultNoFraction",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"partial-short\"",
     {"s.toml:5: fault[1].parameters", "fraction is missing", "allowed"}},
    {"FaultResistance",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"partial-short\"\nparameters = { "
     "fraction = 0.5, short_resistance = -1.0 }",
     {"s.toml:9: fault[1].parameters.short_resistance = -1 ohm", "allowed: 0 to inf"}},
    {"FaultHalfAKey",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"\nparameters = { gai = "
     "0.5 }",
     {"s.toml:9: fault[1].parameters.gai", "unknown key",
      "allowed with kind current-sensor: gain, offset, stuck"}},
    {"FaultNothing",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"",
     {"s.toml:5: fault[1].parameters", "change nothing", "allowed with kind current-sensor"}},
    {"FaultOffsetInf",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"\nparameters = { "
     "offset = inf }",
     {"s.toml:9: fault[1].parameters.offset = inf", "allowed"}},
    {"FaultStuckNumber",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"\nparameters = { stuck "
     "= 0.5 }",
     {"s.toml:9: fault[1].parameters.stuck = 0.5", "allowed: true or false"}},
    {"FaultSag",
     "",
     "[[fault]]\ntime = 0.0\nkind = \"bus-sag\"\nparameters = { voltage = -3.0 }",
     {"s.toml:8: fault[1].parameters.voltage = -3 V", "allowed: 0 to 100000 V"}},
    {"FaultOpenParameters",
     "",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"open\"\nparameters = { fraction = 0.5 "
     "}",
     {"s.toml:9: fault[1].parameters.fraction", "allowed with kind open: none"}},
    {"ExpectKey",
     "",
     "[expect]\ntouchdwn = false",
     {"s.toml:6: expect.touchdwn", "did you mean touchdown?"}},
    {"ExpectType",
     "",
     "[expect]\ntouchdown = 0",
     {"s.toml:6: expect.touchdown = 0", "allowed: true or false"}},
    {"ExpectNan", "", "[expect]\nmax_orbit = nan", {"s.toml:6: expect.max_orbit = nan", "allowed"}},
    {"ExpectClass",
     "",
     "[expect]\nclassified = \"shorted\"",
     {"s.toml:6: expect.classified = \"shorted\"", "allowed: open, partial-short"}},
};

class ScenarioMessages : public Messages {};

TEST_P(ScenarioMessages, OneLine) {
  ExpectOneLine(Run(ReferenceRigText(), ScenarioText(GetParam().to + std::string("\n"))));
}

INSTANTIATE_TEST_SUITE_P(Table, ScenarioMessages, ::testing::ValuesIn(kScenarioMistakes), NameOf);

class BaseKeys : public CliFolder {};
// A start that the rig cannot give is named with the scenario's own line.
TEST_F(BaseKeys, StartsThatTheRigCannotGive) {
  const std::string rig = ReferenceRigText(),
                    resting = ScenarioText("[start]\nstate = \"resting\"\n");
  ASSERT_EQ(Run(rig, resting).exit, 0);
  const Outcome floats = Run(
      Replaced(rig, "gravity = [0.0, -9.81, 0.0]", "gravity = [0.0, 0.0, -9.81]"), resting, "o1");
  EXPECT_EQ(floats.exit, 2);
  EXPECT_NE(floats.text.find("s.toml:6: start.state = \"resting\" without gravity"),
            std::string::npos)
      << floats.text;
  const std::string magnet = ReadText(AMBRIG_SOURCE_DIR "/examples/validation/mbc500.toml");
  const Outcome bare = Run(magnet, resting, "o2");
  EXPECT_EQ(bare.exit, 2);
  EXPECT_NE(bare.text.find("with 0 radial auxiliary bearings, allowed: two"), std::string::npos)
      << bare.text;
  const auto clamped = [](const char* x) {
    return ScenarioText(std::string("[start]\nstate = \"clamped\"\nposition = { M = [") + x +
                        ", 0.0] }\n");
  };
  const Outcome inside = Run(magnet, clamped("-5.0e-4"), "o3");  // both magnets: gap of 0.3 mm
  EXPECT_EQ(inside.exit, 2);
  EXPECT_NE(inside.text.find("allowed: inside the gap of 0.0003 m"), std::string::npos)
      << inside.text;
  EXPECT_EQ(Run(magnet, clamped("-2.0e-4"), "o4").exit, 0);
}

// What the scenario's own first lines may get wrong.
TEST_F(BaseKeys, OneLineEach) {
  const std::pair<const char*, const char*> replaced[] = {
      {"duration = 0.01", "duration = 0.0"},
      {"duration = 0.01", "duration = inf"},
      {"duration = 0.01", "duration = nan"},
      {"record_rate = 12500.0", "record_rate = 13000.0"},
      {"record_rate = 12500.0", "record_rate = -1.0"},
      {"record_rate = 12500.0", "record_rate = inf"},
      {"name = \"t\"", "name = 3"}};
  for (const auto& [from, to] : replaced) {
    const Outcome o = Run(ReferenceRigText(), Replaced(ScenarioText(""), from, to));
    EXPECT_EQ(o.exit, 2) << to << ": " << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_NE(o.text.find("s.toml:"), std::string::npos) << o.text;
    EXPECT_NE(o.text.find("allowed"), std::string::npos) << o.text;
    EXPECT_EQ(Files(), "rig.toml s.toml ");
  }
}

}  // namespace
}  // namespace ambrig
