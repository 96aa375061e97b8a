// Shafts of files of their own, and rotors of ROSS as TOML.
#include "rotor/shaft/shaft_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    bool ross = false;
    std::vector<std::string> ignored;
    ReadShaft(fuzz::FileOf(data, size, ".toml"), &ross, &ignored);
  });
}
