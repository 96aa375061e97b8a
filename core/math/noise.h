#pragma once
/// Counter-based normal noise: value = function of (seed, stream, index), whatever was asked
/// before, on every machine the same bits.
///
///   words  = Philox4x32(counter, key)    7 rounds; Salmon et al. 2011, "Parallel random numbers:
///                                        as easy as 1, 2, 3"
///   r      = sqrt(-2 ln u),  u in (0, 1] from 31 bits, so |value| < 6.7
///   values = r cos(2π v), r sin(2π v)    Box and Muller 1958
///
/// ln, sin, cos and sqrt are own, of +, - and * in single precision (error 2e-7); no library
/// function takes part and nothing is contracted (-ffp-contract=off): the same bits with and
/// without AVX2.
#include <array>
#include <cstdint>

namespace ambrig {

/// n standard normals: block `index` of stream `stream`. A longer block begins with the shorter
/// one.
void FillNormals(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, float* out, int n);

/// One standard normal, never one of those that FillNormals gives.
double Normal(std::uint64_t seed, std::uint32_t stream, std::uint64_t index);

/// Uniform in [0, 1) from 32 bits, of the same key and counter.
double Uniform(std::uint64_t seed, std::uint32_t stream, std::uint32_t index);

/// The bits behind it, for the test against published values.
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

}  // namespace ambrig
