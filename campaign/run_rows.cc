#include "campaign/run_rows.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <charconv>
#include <numeric>

namespace ambrig {

Shard ParseShard(const std::string& text) {
  const std::size_t slash = text.find('/');
  std::size_t i = 0, n = 0;
  const auto number = [](std::string_view s, std::size_t& out) {
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), out);
    return error == std::errc{} && end == s.data() + s.size();
  };
  const std::string_view all = text;
  if (slash == std::string::npos || !number(all.substr(0, slash), i) ||
      !number(all.substr(slash + 1), n) || i < 1 || i > n)
    throw InputError(fmt::format("--shard = {}, allowed: i/n with 1 <= i <= n, e.g. 2/4", text));
  return {i - 1, n};
}

std::vector<std::size_t> PendingRuns(std::size_t runs, const Shard& shard,
                                     const std::map<std::size_t, Row>& done) {
  std::vector<std::size_t> pending;
  for (std::size_t k = 0; k < runs; ++k)
    if (shard.Has(k) && !done.contains(k)) pending.push_back(k);
  return pending;
}

namespace {

int ThreadsOf(int jobs) { return jobs > 0 ? jobs : tbb::info::default_concurrency(); }

}  // namespace

void OnAllCores(const std::vector<std::size_t>& runs, int jobs, const std::atomic<bool>* stop,
                const std::function<void(std::size_t run)>& work) {
  const int threads = ThreadsOf(jobs);
  // More threads than cores only when asked for; an arena alone does not raise the limit.
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  // Stored before and loaded after, it orders what the threads share for the thread sanitizer too,
  // which does not see oneTBB's own hand-over.
  std::atomic<std::size_t> next;
  next.store(0);
  // One task a thread, each takes the next run: they begin in order and no thread waits for
  // another.
  arena.execute([&] {
    tbb::parallel_for(
        0, threads,
        [&](int) {
          for (std::size_t k = next++; k < runs.size(); k = next++) {
            if (stop && stop->load()) throw Interrupted();
            if (tbb::is_current_task_group_canceling()) return;
            work(runs[k]);
          }
        },
        tbb::simple_partitioner());
  });
  next.load();
}

void RunRows(const RunPlan& plan, const std::vector<std::size_t>& runs, int jobs,
             const std::atomic<bool>* stop, const std::function<void(const Row&)>& finished) {
  const std::size_t together =
      plan.campaign().RunsTogether(static_cast<std::size_t>(ThreadsOf(jobs)));
  std::vector<std::size_t> first;  // of each block, its place in `runs`
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (k == 0 || runs[k] / together != runs[k - 1] / together) first.push_back(k);
  std::vector<std::size_t> blocks(first.size());
  std::iota(blocks.begin(), blocks.end(), 0);
  first.push_back(runs.size());
  OnAllCores(blocks, jobs, stop, [&](std::size_t block) {
    for (std::size_t k = first[block]; k < first[block + 1]; ++k)
      finished(SimulateRow(plan, runs[k], stop));
  });
}

}  // namespace ambrig
