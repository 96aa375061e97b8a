#include "discovery/model/in_parallel.h"

#include <oneapi/tbb/parallel_for.h>

#include <atomic>

namespace ambrig {

void InParallel(std::size_t count, const std::function<void(std::size_t k)>& work) {
  std::atomic<std::size_t> next = 0;  // tasks may start in any order: each takes the next piece
  tbb::parallel_for(
      std::size_t{0}, count, [&](std::size_t) { work(next++); }, tbb::simple_partitioner());
}

}  // namespace ambrig
