// The arithmetic of noise.h on vectors as wide as the including source's target has them. Included
// by noise.cc (any machine), noise_avx2.cc, noise_vaes.cc and noise_avx512.cc only; the unnamed
// namespace keeps them apart.
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/math/aes_round.h"
#include "core/math/normal_table.h"

#if defined(AMBRIG_NOISE_AVX2) || defined(AMBRIG_NOISE_AVX512)
#include <immintrin.h>
#endif

namespace ambrig {
namespace {

#if defined(AMBRIG_NOISE_AVX512)
constexpr int kLanes = 16;
#elif defined(AMBRIG_NOISE_AVX2)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif
constexpr int kRounds = 5;           // "Crush-resistant"; see the paper named in noise.h
constexpr int kBlocks = kLanes / 4;  // of 128 bits, the unit of the cipher
// of the table's eight entries that all words but one in 128 need
[[maybe_unused]] constexpr int kFirstCommon = 23;

using U32 = std::uint32_t;
using U64 = std::uint64_t;
using Bits = U32 __attribute__((vector_size(4 * kLanes)));
using Int = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Real = float __attribute__((vector_size(4 * kLanes)));

/// Words in pairs: two of these are a block.
using Pairs = U64 __attribute__((vector_size(4 * kLanes)));
alignas(64) constexpr U64 kFirstOfBlock[8] = {~0ULL, 0, ~0ULL, 0, ~0ULL, 0, ~0ULL, 0};
alignas(64) constexpr U64 kBlockNumber[8] = {0, 0, 1, 0, 2, 0, 3, 0};

inline Pairs LoadPairs(const U64* p) {
  Pairs out;
  std::memcpy(&out, p, sizeof out);
  return out;
}
/// The same four words in every block.
inline Pairs Repeat(U64 first, U64 second) {
  const Pairs mask = LoadPairs(kFirstOfBlock);
  return ((Pairs{} + first) & mask) | ((Pairs{} + second) & ~mask);
}

struct Keys {
  Bits of[kRounds + 1];
};

/// Weyl sequences from the seed on, in both halves of the key.
inline Keys MakeKeys(U64 seed) {
  Keys keys;
  // golden ratio, sqrt(3) - 1
  const Pairs step = Repeat(0x9E3779B97F4A7C15ULL, 0xBB67AE8584CAA73BULL);
  Pairs next = Repeat(seed, 0);
  for (Bits& key : keys.of) {
    key = (Bits)next;
    next += step;
  }
  return keys;
}

/// The cipher on every block of `v`.
#if defined(AMBRIG_NOISE_AVX512)
inline Bits Encrypt(Bits v, const Keys& keys) {
  __m512i x = (__m512i)(v ^ keys.of[0]);
  for (int round = 1; round < kRounds; ++round)
    x = _mm512_aesenc_epi128(x, (__m512i)keys.of[round]);
  return (Bits)_mm512_aesenclast_epi128(x, (__m512i)keys.of[kRounds]);
}
#elif defined(AMBRIG_NOISE_VAES)
inline Bits Encrypt(Bits v, const Keys& keys) {
  __m256i x = (__m256i)(v ^ keys.of[0]);
  for (int round = 1; round < kRounds; ++round)
    x = _mm256_aesenc_epi128(x, (__m256i)keys.of[round]);
  return (Bits)_mm256_aesenclast_epi128(x, (__m256i)keys.of[kRounds]);
}
#elif defined(AMBRIG_NOISE_AVX2)
inline Bits Encrypt(Bits v, const Keys& keys) {
  const __m256i start = (__m256i)(v ^ keys.of[0]);
  __m128i x = _mm256_castsi256_si128(start), y = _mm256_extracti128_si256(start, 1);
  for (int round = 1; round < kRounds; ++round) {
    const __m128i key = _mm256_castsi256_si128((__m256i)keys.of[round]);
    x = _mm_aesenc_si128(x, key);
    y = _mm_aesenc_si128(y, key);
  }
  const __m128i last = _mm256_castsi256_si128((__m256i)keys.of[kRounds]);
  return (Bits)_mm256_set_m128i(_mm_aesenclast_si128(y, last), _mm_aesenclast_si128(x, last));
}
#else
inline AesState StateOf(Bits v) { return {v[0], v[1], v[2], v[3]}; }
inline Bits Encrypt(Bits v, const Keys& keys) {
  AesState x = StateOf(v ^ keys.of[0]);
  for (int round = 1; round < kRounds; ++round) x = AesRound(x, StateOf(keys.of[round]));
  x = AesLastRound(x, StateOf(keys.of[kRounds]));
  return Bits{x[0], x[1], x[2], x[3]};
}
#endif

/// Coefficients of one power, looked up for every lane; only the five lowest bits of `entry` count.
#if defined(AMBRIG_NOISE_AVX512)
inline Real Coefficients(int power, Bits entry) {
  const float* row = kNormalTable[power];
  return (Real)_mm512_permutex2var_ps(_mm512_load_ps(row), (__m512i)entry,
                                      _mm512_load_ps(row + 16));
}
#elif defined(AMBRIG_NOISE_AVX2)
/// Only of the entries 23 to 30, by their three lowest bits: a register holds no more, and one word
/// in 128 needs more.
constexpr struct CommonNormals {
  alignas(32) float of[kNormalDegree + 1][8] = {};
  constexpr CommonNormals() {
    for (int power = 0; power <= kNormalDegree; ++power)
      for (int entry = kFirstCommon; entry < kFirstCommon + 8; ++entry)
        of[power][entry % 8] = kNormalTable[power][entry];
  }
} kCommonNormals;
inline Real Coefficients(int power, Bits entry) {
  return (Real)_mm256_permutevar8x32_ps(_mm256_load_ps(kCommonNormals.of[power]), (__m256i)entry);
}
#else
inline Real Coefficients(int power, Bits entry) {
  Real out = {};
  for (int k = 0; k < kLanes; ++k) out[k] = kNormalTable[power][entry[k] & 31U];
  return out;
}
#endif

/// p of noise.h times 2^31, from all bits of a word but the lowest, which is the sign.
inline Bits SizeOf(Bits word) {
  return (Bits)(__builtin_convertvector((Int)(word >> 1), Real) + 0.5F);
}

/// Normals from words and their sizes.
inline Bits NormalOf(Bits word, Bits p) {
  const Bits entry = p >> 23;
  const Real t = (Real)((p & 0x7fffffU) | 0x3f800000U) - 1.5F;
  Real size = Coefficients(kNormalDegree, entry);
  for (int power = kNormalDegree - 1; power >= 0; --power)
    size = size * t + Coefficients(power, entry);
  return (Bits)size ^ (word << 31);
}

#ifdef AMBRIG_NOISE_AVX2
/// The same for one word, whatever its size.
inline float NormalOf(U32 word) {
  const U32 p =
      __builtin_bit_cast(U32, static_cast<float>(static_cast<std::int32_t>(word >> 1)) + 0.5F);
  const U32 entry = (p >> 23) & 31U;
  const float t = __builtin_bit_cast(float, (p & 0x7fffffU) | 0x3f800000U) - 1.5F;
  float size = kNormalTable[kNormalDegree][entry];
  for (int power = kNormalDegree - 1; power >= 0; --power)
    size = size * t + kNormalTable[power][entry];
  return __builtin_bit_cast(float, __builtin_bit_cast(U32, size) ^ (word << 31));
}

/// Which lanes need an entry that is not among the common ones.
inline int Rare(Bits p) {
  return _mm256_movemask_ps((__m256)((Int)p < Int{} + ((kFirstCommon + 128) << 23)));
}
#endif

constexpr int kChunk = 64;  // vectors of words at a time

/// Normals of n words, vectors of which the last may be in part.
inline void Normals(const Bits* words, float* out, int n) {
#ifdef AMBRIG_NOISE_AVX2
  struct {
    int vector, lanes;
  } rare[kChunk + 1];
  int rares = 0;
#endif
  for (int k = 0; k * kLanes < n; ++k) {
    const Bits p = SizeOf(words[k]), normals = NormalOf(words[k], p);
    const int left = n - k * kLanes;
    if (left >= kLanes) [[likely]]
      std::memcpy(out + k * kLanes, &normals, sizeof normals);
    else
      std::memcpy(out + k * kLanes, &normals, static_cast<std::size_t>(left) * sizeof(float));
#ifdef AMBRIG_NOISE_AVX2
    // written always, kept if there is one: no branch that is hard to predict
    rare[rares] = {k, Rare(p)};
    rares += rare[rares].lanes != 0;
#endif
  }
#ifdef AMBRIG_NOISE_AVX2
  for (int r = 0; r < rares; ++r)
    for (auto lanes = static_cast<unsigned>(rare[r].lanes); lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes), at = rare[r].vector * kLanes + lane;
      if (at < n) out[at] = NormalOf(words[rare[r].vector][lane]);
    }
#endif
}

/// n normals of a block; value 4 c + w comes from word w of counter c.
inline void Fill(U64 seed, U32 stream, U64 index, float* out, int n) {
  const Keys keys = MakeKeys(seed);
  Pairs counter = Repeat(U64{stream} << 32, index) + LoadPairs(kBlockNumber);
  const Pairs next = Repeat(kBlocks, 0);
  Bits words[kChunk];
  for (; n > 0; n -= kChunk * kLanes, out += kChunk * kLanes) {
    const int count = n < kChunk * kLanes ? n : kChunk * kLanes;
    for (int k = 0; k * kLanes < count; ++k, counter += next)
      words[k] = Encrypt((Bits)counter, keys);
    Normals(words, out, count);
  }
}

}  // namespace
}  // namespace ambrig
