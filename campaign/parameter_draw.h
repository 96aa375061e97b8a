#pragma once
/// Points in the unit cube that cover it evenly, and the step from there to normal deviates: how a
/// campaign draws the true values of parameters known to a standard deviation.
#include <cstdint>
#include <vector>

namespace ambrig {

/// points[draw][dimension], each in (0, 1).
using UnitPoints = std::vector<std::vector<double>>;

/// One point in each of `draws` equal slices of every dimension (McKay, Beckman, Conover 1979).
UnitPoints LatinHypercube(int draws, int dimensions, std::uint64_t seed);

inline constexpr int kSobolDimensions = 21;
/// Sobol's sequence with the direction numbers of Joe and Kuo (2008), shifted bitwise by the seed.
/// @throws std::logic_error for more than kSobolDimensions.
UnitPoints Sobol(int draws, int dimensions, std::uint64_t seed);

/// Well mixed 64 bits of x (splitmix64, Steele et al. 2014): seeds of runs, of draws.
std::uint64_t Mixed(std::uint64_t x);

}  // namespace ambrig
