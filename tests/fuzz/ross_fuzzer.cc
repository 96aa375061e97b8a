// Rotors of ROSS as JSON.
#include "rotor/shaft/ross_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] { ReadRoss(fuzz::FileOf(data, size, ".json")); });
}
