// Equations without a solution: every command ends with one line and exit code 2, or tells it as a
// result (a campaign's row, a check's line); never with a program error, and never with a wrong
// answer.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A law that leaves the range of numbers once the shaft has moved by micrometres.
constexpr const char* kRunaway =
    "\n[[effect]]\nname = \"formula\"\ntarget = \"A\"\n"
    "force = { x = \"exp(1e6*x)\", y = \"0\" }\n";

class NoSolutionOf : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("good.toml", ReferenceRigText());
    Write("rig.toml", ReferenceRigText() + kRunaway);
    Write("s.toml", ScenarioText("[expect]\ndrop = false\n"));
    Write("held.toml", Replaced(ScenarioText("[start]\nstate = \"clamped\"\n"), "duration = 0.01",
                                "duration = 0.02"));
  }
  void ExpectOneLine(const Outcome& o, const std::string& said) const {
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_THAT(o.text, HasSubstr(said));
    EXPECT_THAT(o.text, Not(HasSubstr("program error")));
  }
  /// Records of the good rig for both scenarios, and a case that explains them with the bad one.
  void WriteCase(bool with_held) const {
    for (const char* name : {"s", "held"}) {
      const std::string text =
          Replaced(ReadText(folder_ / (std::string(name) + ".toml")), "rig.toml", "good.toml");
      Write(std::string("good_") + name + ".toml", text);
      ASSERT_EQ(Ambrig("run good_" + std::string(name) + ".toml --quiet --no-report --out .").exit,
                0);
    }
    std::string text =
        "rig = \"rig.toml\"\n[[record]]\nscenario = \"s.toml\"\ndata = \"good_s.h5\"\n";
    if (with_held) text += "[[record]]\nscenario = \"held.toml\"\ndata = \"good_held.h5\"\n";
    Write("case.toml", text);
  }
};

// A force beyond all reason: the integrator would follow the rotor through its bearings for hours.
TEST_F(NoSolutionOf, TooManyStepsOfTheIntegratorsEnd) {
  Write("rig.toml", ReadText(AMBRIG_SOURCE_DIR "/examples/small_spindle/rig.toml") +
                        "\n[[effect]]\nname = \"constant-load\"\ntarget = \"B\"\n"
                        "parameters = { fx = 8.5e5, fy = -2.3e5 }\n");
  const Outcome o = Ambrig("run s.toml --out out --fidelity averaged");
  ExpectOneLine(o, "s.toml: the averaged equations of this rig and scenario could not be");
  EXPECT_THAT(o.text, HasSubstr("they take more than 1000 steps a period up to t = -0."));
}

// The file that was run, when it happened, and what would be allowed; nothing is written.
TEST_F(NoSolutionOf, RunNamesFileAndTime) {
  const Outcome o = Ambrig("run s.toml --out out");
  ExpectOneLine(o, "s.toml: the motion diverged at t = -0.");
  EXPECT_THAT(o.text, HasSubstr("while the loop settled before the start"));
  EXPECT_THAT(o.text, HasSubstr("allowed: forces, voltages and formulas"));
  EXPECT_THAT(o.text, Not(HasSubstr("0000000")));  // no seventeen digits
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/s.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/s.json"));
}

TEST_F(NoSolutionOf, EveryFidelity) {
  for (const char* fidelity : {"reference", "averaged"}) {
    const Outcome o = Ambrig(std::string("run s.toml --out out --fidelity ") + fidelity);
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_THAT(o.text, Not(HasSubstr("program error")));
  }
}

TEST_F(NoSolutionOf, CheckGoesOn) {
  Write("fine.toml", Replaced(ScenarioText("[expect]\ndrop = false\n"), "rig.toml", "good.toml"));
  const Outcome o = Ambrig("check s.toml fine.toml --json out.json");
  EXPECT_EQ(o.exit, 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("the motion diverged"));
  EXPECT_THAT(o.text, HasSubstr("1 met, 1 not met"));
}

TEST_F(NoSolutionOf, ACampaignHasARowForIt) {
  Write("c.toml", "rig = \"rig.toml\"\nduration = 0.01\nseeds = 2\n");
  const Outcome o = Ambrig("campaign c.toml -o camp --json out.json");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("not finished       2 (column note)"));
  EXPECT_EQ(nlohmann::json::parse(ReadText(folder_ / "out.json"))["error"], 2);
  EXPECT_THAT(ReadText(folder_ / "camp/table.csv"), HasSubstr(",error,"));
  EXPECT_THAT(ReadText(folder_ / "camp/table.csv"), HasSubstr("the motion diverged"));
}

TEST_F(NoSolutionOf, CommissionAndCrosscheck) {
  ExpectOneLine(Ambrig("commission rig.toml -o learnt.toml"), "the motion diverged");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "learnt.toml"));
  const Outcome o = Ambrig("crosscheck s.toml");
  EXPECT_EQ(o.exit, 2) << o.text;
  EXPECT_EQ(o.lines(), 1) << o.text;
}

// A model that holds no record explains none: it is the rig file that is wrong, not the data.
TEST_F(NoSolutionOf, ACaseWhoseModelHoldsNothingIsRefused) {
  WriteCase(false);
  for (const char* command : {"compare", "explain"})
    ExpectOneLine(Ambrig(std::string(command) + " case.toml"),
                  "rig.toml: the model does not hold its rotor in any record, allowed: a rig file "
                  "that levitates in the records' scenarios (ambrig run");
}

// Where it holds some, the others are left out; nothing is said of their units.
TEST_F(NoSolutionOf, RecordsThatTheModelLosesAreLeftOut) {
  WriteCase(true);
  const Outcome o = Ambrig("compare case.toml --no-blocks");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("the model does not hold its rotor here"));
  EXPECT_THAT(o.text, Not(HasSubstr("times what it should be")));
}

// A shaft without mass has no equation of motion, whatever the sign of its zero.
TEST_F(NoSolutionOf, AShaftWithoutMassIsRefused) {
  const std::filesystem::path tum =
      std::filesystem::path(AMBRIG_SOURCE_DIR) / "examples" / "tum_mbtr";
  std::filesystem::copy(tum, folder_ / "tum");
  const std::string shaft = ReadText(tum / "shaft.toml");
  for (const char* zero : {"0.0", "-0.0"}) {
    Write("tum/shaft.toml", Replaced(shaft, "rho = 7860.0", std::string("rho = ") + zero));
    ExpectOneLine(Ambrig("run tum/run_up.toml --out out"),
                  "shaft.toml:12: rotor.materials.shaft_steel.rho = 0 kg/m3, allowed: above 0");
    ExpectOneLine(Ambrig("analyze tum/rig.toml"), "rho");
  }
}

struct Formula {
  const char *name, *law, *said;
};

class Formulas : public NoSolutionOf, public ::testing::WithParamInterface<Formula> {};

// A formula is tried before a run: what it gives near the centre must be a number within its range.
TEST_P(Formulas, AreTriedBeforeTheRun) {
  Write("rig.toml", ReferenceRigText() + "\n[[effect]]\nname = \"formula\"\n" + GetParam().law);
  ExpectOneLine(Ambrig("run s.toml --out out"), GetParam().said);
}

INSTANTIATE_TEST_SUITE_P(
    Table, Formulas,
    ::testing::Values(Formula{"Root", "target = \"A\"\nforce = { x = \"sqrt(x)\", y = \"0\" }\n",
                              "\"sqrt(x)\": gives no number at x = y = -1e-5 m"},
                      Formula{"Log", "target = \"A\"\nforce = { x = \"0\", y = \"log(y)\" }\n",
                              "\"log(y)\": gives no number at x = y = -1e-5 m"},
                      Formula{"Pole", "target = \"A\"\nforce = { x = \"1/x\", y = \"0\" }\n",
                              "\"1/x\": gives inf N with the shaft at rest"},
                      Formula{"Huge", "target = \"A\"\nforce = { x = \"1e12\", y = \"0\" }\n",
                              "gives 1000000000000 N"},
                      Formula{"Volts", "target = \"A.coil1\"\nvoltage = \"1e9\"\n",
                              "gives 1000000000 V at x = y = 1e-5 m, allowed -100000 to 100000 V"}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace ambrig
