#pragma once
/// The door to NLopt: the least of a function without derivatives in the unit cube. Nobody else
/// calls it here.
#include <functional>
#include <vector>

namespace ambrig {

/// At most `evaluations` values of f, from `start` on, by Rowan's Subplex (NLopt's SBPLX):
/// deterministic. f may be rough and may return large numbers where nothing works. Exceptions of f
/// pass through. Returns the best x. @throws std::runtime_error of NLopt
std::vector<double> SearchUnitCube(const std::function<double(const std::vector<double>&)>& f,
                                   const std::vector<double>& start, int evaluations);

}  // namespace ambrig
