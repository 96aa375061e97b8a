// Rotors of ROSS as JSON, and what they are converted to.
#include "rotor/shaft/shaft_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    bool ross = false;
    std::vector<std::string> ignored;
    std::vector<RossMagnet> magnets;
    const BeamFile rotor =
        ReadShaft(fuzz::FileOf(data, size, ".json"), &ross, &ignored, nullptr, &magnets);
    BeamText(rotor);
    if (!magnets.empty() && NoRigShaft(rotor.definition).empty()) MagneticRigText(rotor, magnets);
  });
}
