// Rig files: every table, controllers among them.
#include "rig/rig_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses(
      [&] { ReadRigText(std::string(fuzz::TextOf(data, size)), "rig.toml"); });
}
