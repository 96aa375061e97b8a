// The same arithmetic as noise.cc for machines with AVX2 and AES instructions on vectors of 256
// bits; chosen at run time by FillNormals.
#ifdef __x86_64__
#pragma GCC target("avx2,aes,vaes")
#define AMBRIG_NOISE_AVX2  // g++ reads the whole file before the pragma defines __AVX2__
#define AMBRIG_NOISE_VAES
#include "core/math/noise_dispatch.h"
#include "core/math/noise_kernel.h"

namespace ambrig {

void FillFromVaes(U64 seed, U32 stream, U64 index, float* out, int n) {
  Fill(seed, stream, index, out, n);
}

}  // namespace ambrig
#endif
