// What a hostile and a demanding user found and no other suite holds: each case failed before its
// mend.
#include <gmock/gmock.h>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Findings : public CliFolder {
 protected:
  void ExpectOneLine(const Outcome& o, const std::string& said) const {
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_LT(o.text.size(), 400U);
    EXPECT_THAT(o.text, HasSubstr(said));
  }
};

TEST_F(Findings, ACommandThatIsNearlyRightIsGuessed) {
  EXPECT_THAT(Ambrig("runn s.toml").text, HasSubstr("runn is no command, did you mean run?"));
  EXPECT_THAT(Ambrig("analyse rig.toml").text, HasSubstr("did you mean analyze?"));
}

// The verdict stands first; margins, zones and infinities of a loop that is unstable are none.
TEST_F(Findings, AnUnstableLoopHasNoMargins) {
  Write("rig.toml", Replaced(ReferenceRigText(), "kp = 4.0e5", "kp = -4.0e5"));
  const Outcome o = Ambrig("analyze rig.toml");
  EXPECT_THAT(o.text, HasSubstr("\nclosed loop UNSTABLE at 0 to 9000 rpm\n"));
  EXPECT_LT(o.text.find("UNSTABLE"), o.text.find("bearings at the operating point"));
  const auto from = o.text.find("sensitivity"), to = o.text.find("simultaneous-loop");
  ASSERT_LT(from, to);
  const std::string margins = o.text.substr(from, to - from);
  EXPECT_THAT(margins, Not(HasSubstr("inf")));
  for (const char* zone : {" A ", " B ", " C ", " D "}) EXPECT_THAT(margins, Not(HasSubstr(zone)));
}

// An integrator that nothing reads does not make a loop unstable, and none is spoken of.
TEST_F(Findings, AnIdleIntegratorIsNoInstability) {
  Write("rig.toml",
        Replaced(Replaced(ReferenceRigText(), "ki = 6.0e6", "ki = 0.0"), "ki = 4.0e6", "ki = 0.0"));
  const Outcome o = Ambrig("analyze rig.toml");
  EXPECT_THAT(o.text, HasSubstr("closed loop stable at every speed analysed"));
  EXPECT_THAT(o.text, Not(HasSubstr("the controller integrates")));
}

TEST_F(Findings, AFormulaIsNotEchoedWhole) {
  std::string sum = "x";
  for (int k = 0; k < 50000; ++k) sum += "+x";
  Write("rig.toml", ReferenceRigText() +
                        "\n[[effect]]\nname = \"formula\"\ntarget = \"A\"\nforce = { x = \"" + sum +
                        "+q\", y = \"0\" }\n");
  Write("s.toml", ScenarioText(""));
  ExpectOneLine(Ambrig("run s.toml --quiet"), "rig.toml:");
}

// Both windows of one side of a thrust bearing open (Z.coil1 and Z.coil2, which pull towards +z).
// The magnet that is left pulls one way: a load against it holds the rotor up, a load along its
// pull drops it, and without a load nothing brings it back, so that it touches without being
// dropped. Both coils are named, and the magnet left is used.
TEST_F(Findings, BothWindowsOfAThrustSideLeaveOneWay) {
  Write("rig.toml", ReferenceRigText());
  const std::string faults =
      "[[fault]]\ntime = 0.02\ntarget = \"Z.coil1\"\nkind = \"open\"\n"
      "[[fault]]\ntime = 0.02\ntarget = \"Z.coil2\"\nkind = \"open\"\n";
  const auto verdict = [&](const std::string& load) {
    Write("s.toml", Replaced(ScenarioText(load + faults), "duration = 0.01", "duration = 0.3"));
    const std::string text = Ambrig("run s.toml --no-report").text;
    for (const char* said : {"classified     Z.coil1    open", "classified     Z.coil2    open",
                             "redistributed  Z          one way"})
      EXPECT_THAT(text, HasSubstr(said));
    return text;
  };
  EXPECT_THAT(verdict("[[load]]\nplane = \"Z\"\nforce = 20.0\n"), HasSubstr("rotor stayed up"));
  EXPECT_THAT(verdict("[[load]]\nplane = \"Z\"\nforce = -20.0\n"), HasSubstr("rotor dropped"));
  EXPECT_THAT(verdict(""), HasSubstr("touched down, did not drop"));
}

// Springs that couple the directions one-sidedly have no critical speeds in that sense; a shaft in
// the air has rigid motions. Neither is an error of the program.
TEST_F(Findings, CriticalSpeedsWantSymmetricSprings) {
  const std::string published =
      ReadText(AMBRIG_SOURCE_DIR "/examples/validation/friswell_5_9_1.validation.toml");
  const std::string shaft = published.substr(0, published.find("[[check]]")),
                    check =
                        "[[check]]\nquantity = \"critical speeds\"\nunit = \"rpm\"\n"
                        "published = [825.0]\n";
  Write("a.validation.toml",
        Replaced(shaft, "kxx = 1e+06", "kxx = 1e+06\nkxy = 2e5\nkyx = -2e5") + check);
  ExpectOneLine(Ambrig("validate a.validation.toml"), "allowed: symmetric springs");
  Write("b.validation.toml", shaft.substr(0, shaft.find("[[rotor.support]]")) + check);
  const Outcome free = Ambrig("validate b.validation.toml");
  EXPECT_NE(free.exit, 3) << free.text;
  EXPECT_THAT(free.text, Not(HasSubstr("program error")));
}

}  // namespace
}  // namespace ambrig
