// The same arithmetic as noise.cc for machines with AVX-512; chosen at run time by FillNormals.
#ifdef __x86_64__
#pragma GCC target("avx512f,avx512vl,avx512dq,avx512bw,aes,vaes")
#define AMBRIG_NOISE_AVX512  // g++ reads the whole file before the pragma defines __AVX512F__
#include "core/math/noise_dispatch.h"
#include "core/math/noise_kernel.h"

namespace ambrig {

void FillFromAvx512(U64 seed, U32 stream, U64 index, float* out, int n) {
  Fill(seed, stream, index, out, n);
}

}  // namespace ambrig
#endif
