#include "discovery/model/in_parallel.h"

#include <oneapi/tbb/parallel_for.h>

namespace ambrig {

void InParallel(std::size_t count, const std::function<void(std::size_t k)>& work) {
  tbb::parallel_for(std::size_t{0}, count, work);
}

}  // namespace ambrig
