// A campaign of 10^5 rows: its shards merged, its table written.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "campaign/merge.h"
#include "core/base/journal.h"

namespace ambrig {
namespace {

constexpr std::size_t kRows = 100000, kShards = 2;

/// A row as the reference rig gives it, with the number of its run.
std::string RowText(std::size_t run) {
  return fmt::format(
      "{},levitated,A:1,1,exact,open,simultaneous,0.001,157.08,0.4,20.751761532972486,"
      "51.879403832431215,0,0,1135186513210162,,,,,up,1,1,0.0001200000000000001,"
      "0.0001200000000000001,0,1000,2.344810745602446e-06,2.344810745602446e-06,"
      "2.344810745602446e-06,0.00019765518925439756,0,4.268197766116703,39.58930587880142,0,0,no,,"
      ",",
      run);
}

void MergeOfManyRows(benchmark::State& state) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("ambrig_bench_{}", ::getpid());
  std::vector<std::string> shards;
  for (std::size_t s = 0; s < kShards; ++s) {
    shards.push_back((folder / std::to_string(s)).string());
    const std::string header = fmt::format(
        R"({{"ambrig_campaign":1,"name":"b","file":"/b.toml","fingerprint":"f","runs":{}}})",
        kRows);
    Journal journal(shards.back() + "/journal.txt", header, {});
    for (std::size_t run = s; run < kRows; run += kShards) journal.Append(RowText(run));
  }
  for (auto _ : state) {
    const JournalContent all = MergeJournals(shards, false);
    WriteTable(folder.string(), all.rows);
    benchmark::DoNotOptimize(CountRows(all.rows));
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(kRows * state.iterations()));
  std::filesystem::remove_all(folder);
}
BENCHMARK(MergeOfManyRows)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ambrig
