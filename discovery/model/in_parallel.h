#pragma once
/// Independent pieces of work on all cores. The door of oneTBB in this folder.
#include <cstddef>
#include <functional>

namespace ambrig {

/// Calls `work` for 0 to count - 1 at the same time, begun in this order: the longest should be the
/// first. Each writes its own result: sums over them are made afterwards, in their order, so that
/// they have the same bits on any number of cores. The first exception ends all.
void InParallel(std::size_t count, const std::function<void(std::size_t k)>& work);

}  // namespace ambrig
