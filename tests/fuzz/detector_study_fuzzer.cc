// Studies of detectors.
#include "campaign/detector_study.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] { ReadDetectorStudy(fuzz::FileOf(data, size, ".toml")); });
}
