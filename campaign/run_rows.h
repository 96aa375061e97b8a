#pragma once
/// Runs of a campaign on all cores. The door of oneTBB in this folder.
#include <functional>

#include "campaign/row.h"

namespace ambrig {

/// Which runs are this machine's: blocks of `together` runs are dealt out in turn.
struct Shard {
  std::size_t index = 0, count = 1, together = 1;
  /// Index of the shard that makes this run.
  std::size_t Of(std::size_t run) const { return run / together % count; }
  bool Has(std::size_t run) const { return Of(run) == index; }
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

/// Simulates `runs` on `jobs` threads (0: all cores), begun in their order, those of a plant by one
/// thread where there are plants enough: a second thread would wait for its commissioning.
/// `finished` is called from any thread, whenever a run is done. The first exception ends all.
/// @throws Interrupted
void RunRows(const RunPlan& plan, const std::vector<std::size_t>& runs, int jobs,
             const std::atomic<bool>* stop, const std::function<void(const Row&)>& finished);

}  // namespace ambrig
