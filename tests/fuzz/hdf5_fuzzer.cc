// Records as HDF5, their attributes among them.
#include "core/record/read_record.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] { ReadMeasurement(fuzz::FileOf(data, size, ".h5")); });
}
