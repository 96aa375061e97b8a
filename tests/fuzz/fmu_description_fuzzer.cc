// modelDescription.xml of an FMU.
#include "control/external/fmu_description.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses(
      [&] { ReadFmuInterface(fuzz::FileOf(data, size, ".xml"), "controller.fmu"); });
}
