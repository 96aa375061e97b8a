#include "core/math/noise.h"

#include "core/math/noise_dispatch.h"
#include "core/math/noise_kernel.h"

namespace ambrig {

void FillFromBaseline(U64 seed, U32 stream, U64 index, U32 chunk, float* out, int n) {
  Fill(seed, stream, index, chunk, out, n);
}

#ifdef __x86_64__
bool HasAvx2() { return __builtin_cpu_supports("avx2") != 0; }

bool HasAvx512() {
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
         __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0;
}
#endif

void FillNormals(U64 seed, U32 stream, U64 index, float* out, int n) {
#ifdef __x86_64__
  static const bool avx512 = HasAvx512() && HasAvx2(), avx2 = HasAvx2();
  // Whole double chunks in the widest; a rest of up to one chunk would waste half of it.
  const int wide = !avx512 ? 0 : n % (2 * kChunk) > kChunk ? n : n - n % (2 * kChunk);
  if (wide > 0) FillFromAvx512(seed, stream, index, 0, out, wide);
  if (wide >= n) return;
  const U32 chunk = static_cast<U32>(wide / kChunk);
  if (avx2) return FillFromAvx2(seed, stream, index, chunk, out + wide, n - wide);
#endif
  Fill(seed, stream, index, 0, out, n);
}

double Normal(U64 seed, U32 stream, U64 index) {
  // Blocks count chunks from 0 and never come to the last one.
  float value = 0;
  Fill(seed, stream, index, 0x1fffffffU, &value, 1);
  return value;
}

std::array<U32, 4> Philox4x32(std::array<U32, 4> c, std::array<U32, 2> key) {
  Words w = {Wide{} + c[0], Wide{} + c[1], Wide{} + c[2], Wide{} + c[3]}, same = w;
  Philox(w, same, MakeKeys(key[0], key[1]));
  return {static_cast<U32>(w.w0[0]), static_cast<U32>(w.w1[0]), static_cast<U32>(w.w2[0]),
          static_cast<U32>(w.w3[0])};
}

double Uniform(std::uint64_t seed, std::uint32_t stream, std::uint32_t index) {
  return static_cast<double>(Philox4x32({index, stream, 0, 0}, {static_cast<U32>(seed), static_cast<U32>(seed >> 32)})[0]) / 4294967296.0;
}

}  // namespace ambrig
