#include "core/math/noise.h"

#include <cmath>
#include <numbers>

#include "core/math/noise_dispatch.h"
#include "core/math/noise_kernel.h"

namespace ambrig {

void FillFromBaseline(U64 seed, U32 stream, U64 index, float* out, int n) {
  Fill(seed, stream, index, out, n);
}

#ifdef __x86_64__
bool HasAvx2() { return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("aes") != 0; }

#ifdef __clang__  // clang 16 has no name for this feature; the clones give the same bits
bool HasVaes() { return false; }
#else
bool HasVaes() { return HasAvx2() && __builtin_cpu_supports("vaes") != 0; }
#endif

bool HasAvx512() {
  return HasVaes() && __builtin_cpu_supports("avx512f") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512bw") != 0;
}
#endif

void FillNormals(U64 seed, U32 stream, U64 index, float* out, int n) {
#ifdef __x86_64__
  static FillFunction* const fill = HasAvx512() ? FillFromAvx512
                                    : HasVaes() ? FillFromVaes
                                    : HasAvx2() ? FillFromAvx2
                                                : FillFromBaseline;
  fill(seed, stream, index, out, n);
#else
  Fill(seed, stream, index, out, n);
#endif
}

std::array<U32, 4> Philox4x32(std::array<U32, 4> c, std::array<U32, 2> key) {
  for (int round = 0; round < 7; ++round) {  // "Crush-resistant"; see the paper named in the header
    const U64 p0 = U64{0xD2511F53U} * c[0], p1 = U64{0xCD9E8D57U} * c[2];
    c = {static_cast<U32>(p1 >> 32) ^ c[1] ^ key[0], static_cast<U32>(p1),
         static_cast<U32>(p0 >> 32) ^ c[3] ^ key[1], static_cast<U32>(p0)};
    key = {key[0] + 0x9E3779B9U, key[1] + 0xBB67AE85U};
  }
  return c;
}

namespace {
std::array<U32, 2> KeyOf(U64 seed) {
  return {static_cast<U32>(seed), static_cast<U32>(seed >> 32)};
}
}  // namespace

double Normal(U64 seed, U32 stream, U64 index) {
  const std::array<U32, 4> w = Philox4x32(
      {0xfffffff8U, stream, static_cast<U32>(index), static_cast<U32>(index >> 32)}, KeyOf(seed));
  const double u = ((w[0] >> 1) + 0.5) * 0x1p-31;  // Box and Muller
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * 0x1p-32 * w[1]);
}

double Uniform(U64 seed, U32 stream, U32 index) {
  return 0x1p-32 * Philox4x32({index, stream, 0, 0}, KeyOf(seed))[0];
}

}  // namespace ambrig
