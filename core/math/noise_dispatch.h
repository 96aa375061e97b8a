#pragma once
/// The clones of FillNormals, bit for bit the same: for noise.cc, which chooses, and for the tests.
#include <cstdint>

namespace ambrig {

using FillFunction = void(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, float* out,
                          int n);

FillFunction FillFromBaseline;  // any machine
#ifdef __x86_64__
FillFunction FillFromAvx2;    // and AES instructions
FillFunction FillFromVaes;    // and AES instructions on vectors
FillFunction FillFromAvx512;  // and AES instructions on whole vectors
bool HasAvx2();
bool HasVaes();
bool HasAvx512();
#endif

}  // namespace ambrig
