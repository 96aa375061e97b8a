#pragma once
/// Runs of a campaign on all cores. The door of oneTBB in this folder.
#include <functional>

#include "campaign/row.h"

namespace ambrig {

/// Which runs are this machine's: those with run % count == index.
struct Shard {
  std::size_t index = 0, count = 1;
  bool Has(std::size_t run) const { return run % count == index; }
};
/// "2/4" is the second of four. @throws InputError
Shard ParseShard(const std::string& text);

/// Runs of the shard that `done` does not hold, in order.
std::vector<std::size_t> PendingRuns(std::size_t runs, const Shard& shard,
                                     const std::map<std::size_t, Row>& done);

/// Calls `work` for every one of `runs` on `jobs` threads (0: all cores), begun in their order. The
/// first exception ends all. @throws Interrupted
void OnAllCores(const std::vector<std::size_t>& runs, int jobs, const std::atomic<bool>* stop,
                const std::function<void(std::size_t run)>& work);

/// Simulates `runs` on `jobs` threads (0: all cores), begun in their order; `finished` is called
/// from any thread, whenever one is done. The first exception ends all. @throws Interrupted
void RunRows(const RunPlan& plan, const std::vector<std::size_t>& runs, int jobs,
             const std::atomic<bool>* stop, const std::function<void(const Row&)>& finished);

}  // namespace ambrig
