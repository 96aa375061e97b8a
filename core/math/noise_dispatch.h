#pragma once
/// The clones of FillNormals, bit for bit the same: for noise.cc, which chooses, and for the tests.
#include <cstdint>

namespace ambrig {

/// n normals of a block from its chunk `chunk` (32 normals each) on.
using FillFromFunction = void(std::uint64_t seed, std::uint32_t stream, std::uint64_t index,
                              std::uint32_t chunk, float* out, int n);

FillFromFunction FillFromBaseline;  // any machine
#ifdef __x86_64__
FillFromFunction FillFromAvx2;
FillFromFunction FillFromAvx512;  // steps of two chunks
bool HasAvx2();
bool HasAvx512();
#endif

}  // namespace ambrig
