#include "campaign/parameter_draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/errors.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

constexpr int kBits = 32;

/// Primitive polynomial (degree, inner coefficients) and first direction numbers.
struct Direction {
  int degree;
  unsigned inner;
  std::array<unsigned, 7> first;
};
constexpr Direction kJoeKuo[kSobolDimensions - 1] = {
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
};

std::array<std::uint32_t, kBits> Directions(int dimension) {
  std::array<std::uint32_t, kBits> v{};
  if (dimension == 0) {
    for (int k = 0; k < kBits; ++k) v[static_cast<std::size_t>(k)] = 1u << (kBits - 1 - k);
    return v;
  }
  const Direction& d = kJoeKuo[dimension - 1];
  const auto s = static_cast<std::size_t>(d.degree);
  for (std::size_t k = 0; k < kBits; ++k) {
    if (k < s) {
      v[k] = d.first[k] << (kBits - 1 - k);
      continue;
    }
    v[k] = v[k - s] ^ (v[k - s] >> s);
    for (std::size_t j = 1; j < s; ++j)
      if (d.inner >> (s - 1 - j) & 1) v[k] ^= v[k - j];
  }
  return v;
}

/// Uniform in (0, 1) from 53 of 64 bits.
double Uniform(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53; }

}  // namespace

std::uint64_t Mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

UnitPoints LatinHypercube(int draws, int dimensions, std::uint64_t seed) {
  const auto n = static_cast<std::size_t>(draws), m = static_cast<std::size_t>(dimensions);
  UnitPoints points(n, std::vector<double>(m));
  for (std::size_t d = 0; d < m; ++d) {
    std::uint64_t state = Mixed(seed * 1000003 + d);
    std::vector<std::size_t> slice(n);
    std::iota(slice.begin(), slice.end(), std::size_t{0});
    for (std::size_t k = n; k > 1; --k) {  // Fisher-Yates; std::shuffle differs between libraries
      state = Mixed(state);
      std::swap(slice[k - 1], slice[state % k]);
    }
    for (std::size_t k = 0; k < n; ++k) {
      state = Mixed(state);
      points[k][d] = (static_cast<double>(slice[k]) + Uniform(state)) / static_cast<double>(n);
    }
  }
  return points;
}

UnitPoints Sobol(int draws, int dimensions, std::uint64_t seed) {
  Require(dimensions <= kSobolDimensions, "Sobol dimensions");
  const auto n = static_cast<std::size_t>(draws), m = static_cast<std::size_t>(dimensions);
  UnitPoints points(n, std::vector<double>(m));
  for (std::size_t d = 0; d < m; ++d) {
    const auto v = Directions(static_cast<int>(d));
    auto x = static_cast<std::uint32_t>(Mixed(seed * 1000003 + d) >> 32);
    for (std::size_t k = 0; k < n; ++k) {
      points[k][d] = (static_cast<double>(x) + 0.5) * 0x1p-32;
      std::size_t zero = 0;  // Gray code order (Antonov, Saleev 1979): the lowest zero bit of k
      while (k >> zero & 1) ++zero;
      x ^= v[zero];
    }
  }
  return points;
}

}  // namespace ambrig
