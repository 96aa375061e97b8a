// Cases of measured records; files that they name are looked for beside examples/mls2em/case.toml.
#include "discovery/case/case_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    ReadCaseText(std::string(fuzz::TextOf(data, size)),
                 AMBRIG_SOURCE_DIR "/examples/mls2em/case.toml");
  });
}
