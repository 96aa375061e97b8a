// A controller that is an FMU: the bits of the same law as a library, in both versions of FMI, and
// what an FMU can do wrong.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "core/base/zip_file.h"
#include "core/record/hdf5.h"
#include "tests/campaign/campaign_folder.h"
#include "tests/control/external/external_site.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig::testing {
namespace {

std::string VariableOfFmu(int fmi, const std::string& type, const std::string& name, int reference,
                          const std::string& causality) {
  const std::string start = causality == "output" ? "" : " start=\"0\"";
  if (fmi == 3)
    return fmt::format("<{} name=\"{}\" valueReference=\"{}\" causality=\"{}\"{}/>",
                       type == "Real" ? "Float64" : "Int32", name, reference, causality, start);
  return fmt::format(
      "<ScalarVariable name=\"{}\" valueReference=\"{}\" causality=\"{}\"><{}{}/></ScalarVariable>",
      name, reference, causality, type, start);
}

struct FmuNames {
  std::string position = "position.", force = "force.", token = "{4f1c}", more = "";
};

/// NAME.fmu of tests/control/external/fmus for the axes of the reference rig's [controller].
void WriteControllerFmu(const CampaignFolder& f, const std::string& name, int fmi,
                        const FmuNames& names = {}) {
  std::string variables;
  int k = 0;
  for (const char* axis : {"A.x", "A.y", "B.x", "B.y"}) {
    variables += VariableOfFmu(fmi, "Real", names.position + axis, k, "input");
    variables += VariableOfFmu(fmi, "Real", names.force + axis, 4 + k++, "output");
  }
  variables += VariableOfFmu(fmi, "Real", "kp", 8, "parameter") +
               VariableOfFmu(fmi, "Integer", "mistake", 9, "parameter") +
               VariableOfFmu(fmi, "Real", "speed", 10, "input") + names.more;
  const std::string xml = fmt::format(
      "<?xml version=\"1.0\"?><fmiModelDescription fmiVersion=\"{}.0\" modelName=\"c\" "
      "{}=\"{}\"><CoSimulation modelIdentifier=\"c\"/><ModelVariables>{}</ModelVariables>"
      "</fmiModelDescription>",
      fmi, fmi == 2 ? "guid" : "instantiationToken", names.token, variables);
  WriteZip(f.File(name), {{"modelDescription.xml", xml},
                          {fmi == 2 ? "binaries/linux64/c.so" : "binaries/x86_64-linux/c.so",
                           ReadBytes(Module("controller_fmu"))}});
}

std::string FmuRig(const std::string& lines) {
  const std::string text = ReferenceText();
  return text.substr(0, text.find("[controller]")) +
         "[controller]\nrate = 12500.0\nbias_current = 2.0\nf_max = 60.0\n" + lines + "\n" +
         text.substr(text.find("[bearings.A]"));
}

void WriteFmuScenario(const CampaignFolder& f, const std::string& name) {
  f.Write("run_" + name + ".toml", "name = \"s\"\nrig = \"" + name +
                                       ".toml\"\nduration = 0.02\nfault_tolerance = false\n"
                                       "[speed]\nprofile = [[0.0, 300.0]]\n");
}

TEST(FmuController, GivesTheBitsOfTheSameLawAsALibrary) {
  const CampaignFolder f;
  WriteControllerFmu(f, "two.fmu", 2);
  WriteControllerFmu(f, "three.fmu", 3, {"y_", "u_"});
  f.Write("c.toml", FmuRig("kind = \"library\"\nfile = \"" + Module("plain_pi") +
                           "\"\nparameters = { kp = 3.5e5 }\n"));
  f.Write("two.toml", FmuRig("kind = \"fmu\"\nfile = \"two.fmu\"\nparameters = { kp = 3.5e5 }\n"));
  std::string mapped =
      "kind = \"fmu\"\nfile = \"three.fmu\"\nparameters = { kp = 3.5e5 }\n"
      "[controller.variables]\n";
  for (const char* axis : {"A.x", "A.y", "B.x", "B.y"})
    mapped += fmt::format("\"position.{0}\" = \"y_{0}\"\n\"force.{0}\" = \"u_{0}\"\n", axis);
  f.Write("three.toml", FmuRig(mapped));
  for (const char* name : {"c", "two", "three"}) WriteFmuScenario(f, name);
  const Outcome run = f.Ambrig("run run_c.toml run_two.toml run_three.toml --no-report");
  ASSERT_EQ(run.exit, 0) << run.text;
  const Record c = ReadHdf5(f.File("out/run_c.h5"));
  ASSERT_GT(c.rows(), 200U);
  for (const char* other : {"two", "three"}) {
    const Record r = ReadHdf5(f.File(std::string("out/run_") + other + ".h5"));
    ASSERT_EQ(r.channels.size(), c.channels.size());
    for (std::size_t k = 0; k < c.channels.size(); ++k)
      EXPECT_EQ(r.channels[k].samples, c.channels[k].samples)
          << other << ": " << c.channels[k].name;
  }
}

struct FmuMistake {
  int mistake;
  const char* words;
};

TEST(FmuController, WhatItDoesWrongEndsTheRunWithASentence) {
  constexpr FmuMistake kMistakes[] = {
      {1, "nan, allowed: finite numbers"},
      {2, "divided an integer by zero (SIGFPE)"},
      {3, "crashed: it touched memory that is not its own (SIGSEGV)"},
      {4, "did not answer within 1 s, an endless loop? (key timeout)"},
      {5, "DoStep of the FMU returned Error: the plant is lost"},
      {6, "ended its own process with exit code 5"},
  };
  const CampaignFolder f;
  for (const int fmi : {2, 3}) {
    WriteControllerFmu(f, "c.fmu", fmi);
    WriteFmuScenario(f, "rig");
    for (const FmuMistake& m : kMistakes) {
      f.Write("rig.toml", FmuRig(fmt::format("kind = \"fmu\"\nfile = \"c.fmu\"\ntimeout = 1.0\n"
                                             "parameters = {{ mistake = {} }}\n",
                                             m.mistake)));
      const Outcome run = f.Ambrig("run run_rig.toml --no-report");
      EXPECT_EQ(run.exit, 2) << run.text;
      EXPECT_NE(run.text.find("rig.toml:"), std::string::npos) << run.text;
      EXPECT_NE(run.text.find("controller.file = \"c.fmu\": "), std::string::npos) << run.text;
      EXPECT_NE(run.text.find(m.words), std::string::npos) << run.text;
    }
  }
}

TEST(FmuController, WhatDoesNotFitIsSaidBeforeTheRun) {
  const CampaignFolder f;
  WriteFmuScenario(f, "rig");
  const auto expect = [&f](const std::string& lines, const std::string& words) {
    f.Write("rig.toml", FmuRig("kind = \"fmu\"\nfile = \"c.fmu\"\n" + lines));
    const Outcome run = f.Ambrig("run run_rig.toml --no-report");
    EXPECT_EQ(run.exit, 2) << run.text;
    EXPECT_NE(run.text.find(words), std::string::npos) << run.text;
  };
  f.Write("c.fmu", "no zip");
  expect("", "c.fmu: cannot be unpacked: ");
  WriteControllerFmu(f, "c.fmu", 2, {"position.", "effort."});
  expect("", "the FMU has no output force.A.x, allowed: outputs force.A.x, force.A.y");
  WriteControllerFmu(f, "c.fmu", 2, {"place.", "force."});
  expect("", "nothing is known of the FMU's input place.A.x, allowed: position.A.x");
  WriteControllerFmu(f, "c.fmu", 2);
  expect("parameters = { kq = 1.0 }\n", "the FMU has no parameter kq (key parameters)");
  expect("commands = \"currents\"\n", "the FMU has no output command.A.coil1");
  expect("[controller.variables]\n\"position.C.x\" = \"a\"\n",
         "variables: \"position.C.x\" is nothing that this rig has");
  WriteControllerFmu(f, "c.fmu", 2, {"position.", "force.", "{other}"});
  expect("", "instantiation of the FMU returned Error");
  WriteZip(f.File("c.fmu"), {{"../out.txt", "x"}});
  expect("", "the entry \"../out.txt\" leads out of the archive");
}

}  // namespace
}  // namespace ambrig::testing
