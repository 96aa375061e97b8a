// Journals: of campaigns, of practice, and of what explain keeps.
#include "core/base/journal.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    ReadJournalFile(
        fuzz::FileOf(data, size, ".jsonl"),
        {.header = [](std::string_view) {}, .entry = [](const JournalEntry&) { return true; }});
  });
}
