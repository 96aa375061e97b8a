// Scenario files of the reference rig.
#include "rig/rig_file.h"
#include "scenarios/scenario.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    static const RigParameters rig = ReadRig(AMBRIG_SOURCE_DIR "/examples/reference/rig.toml");
    ReadScenarioText(std::string(fuzz::TextOf(data, size)), "scenario.toml", rig);
  });
}
