#pragma once
/// Counter-based normal noise: value = function of (seed, stream, index), whatever was asked
/// before, on every machine the same bits.
///
///   word  = ARS4x32(counter, key)     5 rounds of the AES; Salmon et al. 2011, "Parallel random
///                                     numbers: as easy as 1, 2, 3"
///   value = ± z(p),  P(|value| > z) = p    from 31 bits, so |value| < 6.3; polynomials over the
///                                     octaves of p, error below 4e-5 (tools/normal_table.py)
///
/// In single precision of + and *, nothing contracted (-ffp-contract=off), no library function:
/// the same bits with and without AES instructions and wide registers.
#include <array>
#include <cstdint>

namespace ambrig {

/// n standard normals: block `index` of stream `stream`. A longer block begins with the shorter
/// one.
void FillNormals(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, float* out, int n);

/// One standard normal, of Philox4x32 (7 rounds, same paper) by Box and Muller: for draws that are
/// few.
double Normal(std::uint64_t seed, std::uint32_t stream, std::uint64_t index);

/// Uniform in [0, 1) from 32 bits.
double Uniform(std::uint64_t seed, std::uint32_t stream, std::uint32_t index);

/// The bits behind it, for the test against published values.
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

}  // namespace ambrig
