#pragma once
/// The flexible rig of TU Munich (examples/tum_mbtr) as text that tests change.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/base/read_file.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "scenarios/scenario.h"
#include "tests/rig/exact_coils.h"

namespace ambrig::testing {

inline const std::string kTumFolder = std::string(AMBRIG_SOURCE_DIR) + "/examples/tum_mbtr/";

inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The rig's text with its shaft inside, so that tests can change both; then `changes`, from and
/// to.
inline std::string TumRigText(
    const std::vector<std::pair<std::string, std::string>>& changes = {}) {
  const std::string shaft = ReadFile(kTumFolder + "shaft.toml");
  std::string text = Replaced(ReadFile(kTumFolder + "rig.toml"), "file = \"shaft.toml\"",
                              "modes = 4\nelements_per_section = 4");
  text =
      Replaced(text, "[amplifier]", shaft.substr(shaft.find("[rotor.materials")) + "\n[amplifier]");
  for (const auto& [from, to] : changes) text = Replaced(text, from, to);
  return text;
}

inline RigParameters TumRig(const std::string& text) {
  return WithExactCoils(ReadRigText(text, kTumFolder + "rig.toml"));
}

inline RigParameters Mbtr() { return WithExactCoils(ReadRig(kTumFolder + "rig.toml")); }

/// Nothing recorded but the motion, at one speed [rad/s].
inline Scenario Quiet(const RigParameters& rig, double duration, double speed) {
  return ReadScenarioText(
      fmt::format("duration = {}\nrecord_rate = 12500.0\nnoise = false\n[speed]\nprofile = "
                  "[[0.0, {}]]\n",
                  duration, NumberText(speed)),
      kTumFolder + "test.toml", rig);
}

}  // namespace ambrig::testing
