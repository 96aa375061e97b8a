// The arithmetic of noise.h on vectors as wide as the including source's target has them. Included
// by noise.cc (any machine), noise_avx2.cc and noise_avx512.cc only; the unnamed namespace keeps
// them apart.
//
// Philox multiplies 32 x 32 -> 64 bits, so its words lie in the lower halves of 64-bit lanes, the
// upper halves being ignored: counters 0, 2, 4 ... in one vector, 1, 3, 5 ... in another.
#include <cstdint>
#include <cstring>
#include <initializer_list>

#ifdef __SSE2__
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
constexpr int kRounds = 7;             // "Crush-resistant"; see the paper named in noise.h
constexpr int kCounters = 8;           // of a chunk, the unit of the order in a block
constexpr int kChunk = 4 * kCounters;  // normals that they give
constexpr int kStep = kLanes > kCounters ? 2 * kChunk : kChunk;  // normals of one FillStep

using U32 = std::uint32_t;
using U64 = std::uint64_t;
using Wide = U64 __attribute__((vector_size(4 * kLanes)));
using Bits = U32 __attribute__((vector_size(4 * kLanes)));
using Int = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Real = float __attribute__((vector_size(4 * kLanes)));

inline Wide Multiply(Wide a, Wide b) {
#if defined(AMBRIG_NOISE_AVX512)
  // The unmasked form makes g++ 12 warn of an uninitialised variable in its own header.
  return (Wide)_mm512_maskz_mul_epu32(0xff, (__m512i)a, (__m512i)b);
#elif defined(AMBRIG_NOISE_AVX2)
  return (Wide)_mm256_mul_epu32((__m256i)a, (__m256i)b);
#elif defined(__SSE2__)
  return (Wide)_mm_mul_epu32((__m128i)a, (__m128i)b);
#else
  return (a & 0xffffffffU) * (b & 0xffffffffU);
#endif
}

struct Words {
  Wide w0, w1, w2, w3;
};

/// The keys of the rounds, ready as vectors.
struct Keys {
  Wide k0[kRounds], k1[kRounds];
};

inline Keys MakeKeys(U32 k0, U32 k1) {
  Keys keys;
  for (int round = 0; round < kRounds; ++round) {
    keys.k0[round] = Wide{} + k0;
    keys.k1[round] = Wide{} + k1;
    k0 += 0x9E3779B9U;
    k1 += 0xBB67AE85U;
  }
  return keys;
}

inline void Round(Words& c, Wide k0, Wide k1) {
  const Wide p0 = Multiply(c.w0, Wide{} + 0xD2511F53U), p1 = Multiply(c.w2, Wide{} + 0xCD9E8D57U);
  c = {(p1 >> 32) ^ (c.w1 ^ k0), p1, (p0 >> 32) ^ (c.w3 ^ k1), p0};
}

/// Both in one loop: each waits for its own products most of the time.
inline void Philox(Words& even, Words& odd, const Keys& keys) {
  for (int round = 0; round < kRounds; ++round) {
    Round(even, keys.k0[round], keys.k1[round]);
    Round(odd, keys.k0[round], keys.k1[round]);
  }
}

inline Bits Interleave(Wide even, Wide odd) { return (Bits)((even & 0xffffffffU) | (odd << 32)); }

/// Several vectors treated alike. Their operations alternate: each function is a chain of operations that wait
/// for one another, and a processor does not look far enough ahead to mix chains that follow one another.
template <class T, int kCount>
struct Several {
  T of[kCount];
  T& operator[](int k) { return of[k]; }
  const T& operator[](int k) const { return of[k]; }
};
constexpr int kPairs = kLanes > kCounters ? 2 : 1;  // at once, of the two that a counter gives: as registers allow
using Reals = Several<Real, kPairs>;
using BitsOfAll = Several<Bits, kPairs>;

template <class F>
inline auto Each(const F& f) {
  Several<decltype(f(0)), kPairs> out;
  for (int k = 0; k < kPairs; ++k) out[k] = f(k);
  return out;
}

/// ln u for u in [2^-32, 1]: u = 2^e (1 + f), 1 + f in [sqrt(1/2), sqrt(2)), and
/// ln(1 + f) = f + f² L(f), L the Chebyshev interpolant of degree 7.
inline Reals Log(const Reals& u) {
  const auto e = Each([&](int k) { return ((Int)u[k] - 0x3f3504f3) >> 23; });
  const auto f = Each([&](int k) { return (Real)((Int)u[k] - (e[k] << 23)) - 1.0F; });
  auto L = Each([&](int k) { return 0.0878726551F * f[k] - 0.14159647F; });
  for (const float c : {0.148347868F, -0.165884885F, 0.199720497F, -0.250011477F, 0.333336706F, -0.499999971F})
    L = Each([&](int k) { return L[k] * f[k] + c; });
  return Each([&](int k) { return __builtin_convertvector(e[k], Real) * 0.693147181F + (f[k] + f[k] * f[k] * L[k]); });
}

/// sqrt x for x in [0, 50]: Newton's iteration for 1 / sqrt x; halving the exponent starts it
/// within 3.5 %, which becomes 2e-3, 5e-6, 4e-11 (error -> 3/2 error²).
inline Reals SquareRoot(const Reals& x) {
  const auto half = Each([&](int k) { return 0.5F * x[k]; });
  auto y = Each([&](int k) { return (Real)(0x5f3759dfU - ((Bits)x[k] >> 1)); });
  for (int iteration = 0; iteration < 3; ++iteration) y = Each([&](int k) { return y[k] * (1.5F - half[k] * y[k] * y[k]); });
  return Each([&](int k) { return x[k] * y[k]; });
}

/// Normals from pairs of words: radius from the first, angle 2π w / 2³² from the second. The angle is q
/// quarter turns and a rest t in [-π/4, π/4), turned back by choosing and negating bits.
inline void BoxMuller(const BitsOfAll& radius_word, const BitsOfAll& angle_word, Reals* first, Reals* second) {
  const Reals u = Each([&](int k) { return (__builtin_convertvector((Int)(radius_word[k] >> 1), Real) + 0.5F) * 0x1p-31F; });
  const Reals ln = Log(u), r = SquareRoot(Each([&](int k) { return -2.0F * ln[k]; }));
  const auto q = Each([&](int k) { return (angle_word[k] + 0x20000000U) >> 30; });
  const Reals t = Each([&](int k) { return __builtin_convertvector((Int)(angle_word[k] - (q[k] << 30)), Real) * (1.57079633F * 0x1p-30F); });
  const Reals s = Each([&](int k) { return t[k] * t[k]; });
  const Reals sine = Each([&](int k) { return t[k] + t[k] * s[k] * (-0.166666647F + s[k] * (0.00833274827F - s[k] * 0.000195878909F)); });
  const Reals cosine = Each([&](int k) {
    return 1.0F - 0.5F * s[k] + s[k] * s[k] * (0.0416666647F + s[k] * (-0.0013888303F + s[k] * 2.45479419e-05F));
  });
  const auto swapped = Each([&](int k) { return ((Bits)cosine[k] ^ (Bits)sine[k]) & -(q[k] & 1U); });
  *first = Each([&](int k) { return r[k] * (Real)((Bits)cosine[k] ^ swapped[k] ^ (((q[k] + 1U) & 2U) << 30)); });
  *second = Each([&](int k) { return r[k] * (Real)((Bits)sine[k] ^ swapped[k] ^ ((q[k] & 2U) << 30)); });
}

/// Lanes 0..7 belong to one chunk, 8..15 to the next.
inline void Store(Real x, float* out) {
  constexpr std::size_t kPart = sizeof(float) * (kLanes < kCounters ? kLanes : kCounters);
  std::memcpy(out, &x, kPart);
  if constexpr (kLanes > kCounters)
    std::memcpy(out + kChunk, reinterpret_cast<const char*>(&x) + kPart, kPart);
}

/// 0, 2, 4 ...: the counters of a vector of 64-bit lanes.
inline Wide EvenCounters() {
#if defined(AMBRIG_NOISE_AVX512)
  return Wide{0, 2, 4, 6, 8, 10, 12, 14};
#elif defined(AMBRIG_NOISE_AVX2)
  return Wide{0, 2, 4, 6};
#else
  return Wide{0, 2};
#endif
}

/// Value 8 m + j of a chunk comes from words of counter j, m = 0..3.
inline void FillStep(const Keys& keys, U32 stream, U64 index, U32 chunk, float* out) {
  for (int j = 0; j < kCounters; j += kLanes, out += kLanes) {
    const Wide even = EvenCounters() + (U64{chunk} * kCounters + static_cast<U64>(j));
    Words a = {even, Wide{} + stream, Wide{} + (index & 0xffffffffU), Wide{} + (index >> 32)};
    Words b = {even + 1U, a.w1, a.w2, a.w3};
    Philox(a, b, keys);
    const Bits radius[2] = {Interleave(a.w0, b.w0), Interleave(a.w2, b.w2)}, angle[2] = {Interleave(a.w1, b.w1), Interleave(a.w3, b.w3)};
    for (int pair = 0; pair < 2; pair += kPairs) {
      Reals first, second;
      BoxMuller(Each([&](int k) { return radius[pair + k]; }), Each([&](int k) { return angle[pair + k]; }), &first, &second);
      for (int k = 0; k < kPairs; ++k) {
        Store(first[k], out + 2 * (pair + k) * kCounters);
        Store(second[k], out + (2 * (pair + k) + 1) * kCounters);
      }
    }
  }
}

/// n normals of a block, from its chunk `chunk` on.
inline void Fill(U64 seed, U32 stream, U64 index, U32 chunk, float* out, int n) {
  const Keys keys = MakeKeys(static_cast<U32>(seed), static_cast<U32>(seed >> 32));
  for (; n >= kStep; n -= kStep, out += kStep, chunk += kStep / kChunk)
    FillStep(keys, stream, index, chunk, out);
  if (n <= 0) return;
  float rest[kStep];
  FillStep(keys, stream, index, chunk, rest);
  std::memcpy(out, rest, static_cast<std::size_t>(n) * sizeof(float));
}

}  // namespace
}  // namespace ambrig
