// Rows of a campaign as its journal and its table have them.
#include "campaign/merge.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    const Row row = ParseRow(fuzz::TextOf(data, size), "rows.csv, line 2");
    CheckRow(row, "rows.csv, line 2");
    CountRows({{row.run, row}});
  });
}
