/// Mistakes in a beam rotor and in its shaft file: one line each.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/read_file.h"
#include "rig/rig_file.h"
#include "tests/simulation/tum_rig.h"

namespace ambrig {
namespace {

using testing::kTumFolder;
using testing::Replaced;
using testing::TumRig;
using testing::TumRigText;

struct RotorMistake {
  std::string from, to;
  std::vector<std::string> says;
};

TEST(FlexibleRotorErrors, MistakesAreOneLine) {
  const RotorMistake mistakes[] = {
      {"modes = 4", "modes = 9", {"rotor.modes = 9", "allowed: 0 to 8"}},
      {"modes = 4", "modes = -1", {"rotor.modes", "allowed"}},
      {"z = 0.623\nsensor",
       "z = 0.9\nsensor",
       {"bearings.B.z = 0.9 m", "on the shaft, 0 to 0.702 m"}},
      {"sensor = { z = 0.113", "sensor = { z = -0.2", {"bearings.A.sensor", "on the shaft"}},
      {"auxiliary = { clearance",
       "auxiliary = { z = 2.0, clearance",
       {"bearings.A.auxiliary", "on the shaft"}},
      {"length = 0.094",
       "length = { value = 0.094, sd = 1e-4 }",
       {"rotor.section[1].length", "has an sd", "diameters"}},
      {"journal_radius = 0.0048", "", {"rotor.journal_radius: is missing"}},
      {"name = \"disk\"", "name = \"A\"", {"bearings.A", "disk or station"}},
      {"name = \"disk\"", "name = \"lamination_a\"", {"\"lamination_a\" is taken"}},
      {"target = \"disk\"", "target = \"disc\"", {"disc", "did you mean disk?"}},
      {"[amplifier]",
       "[[rotor.support]]\nname = \"pedestal\"\nz = 0.1\nk = 1e5\nmxx = 5.0\n[amplifier]",
       {"rotor.support", "\"pedestal\" has added masses", "springs and dampers to the ground"}},
      {"[amplifier]",
       "[[rotor.support]]\nname = \"anvil\"\nz = 0.1\nk = 1e12\n[amplifier]",
       {"rotor.support", "\"anvil\" moves the shaft", "twentieth of the switching frequency"}},
      {"switching_frequency = 25000.0",
       "switching_frequency = 400.0",
       {"rotor.modes = 4, allowed: 0 to 3", "mode 4 at 213 Hz",
        "half the switching frequency of 400 Hz"}},
  };
  for (const RotorMistake& m : mistakes) {
    std::string message = "no error";
    try {
      std::string text = Replaced(TumRigText(), m.from, m.to);
      if (m.to.find("400.0") != std::string::npos)
        text = Replaced(text, "rate = 12500.0", "rate = 400.0");
      TumRig(text);
    } catch (const InputError& e) {
      message = e.what();
    }
    for (const std::string& part : m.says)
      EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find("rig.toml:"), std::string::npos) << message;
  }
}

TEST(FlexibleRotorErrors, ShaftFilesThatAreNone) {
  const std::string text = ReadFile(kTumFolder + "rig.toml");
  for (const auto& [file, part] : {std::pair{"nowhere.toml", "nowhere.toml"},
                                   {"shaft.txt", "a .toml or .json file"},
                                   {"nowhere.json", "nowhere.json"},
                                   {"run_up.toml", "no shaft element"}}) {
    try {
      TumRig(Replaced(text, "shaft.toml\"", std::string(file) + "\""));
      ADD_FAILURE() << file;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace ambrig
