#pragma once
/// Eight lanes in one 512-bit register, with the interface and the bits of LaneVector: a tenth
/// faster where the machine has such registers, ten times slower elsewhere. So a hot loop is a
/// template of its vector:
///
///   AMBRIG_WHOLE void LoopWhole(...) { Loop<WholeLaneVector>(...); }
///   AMBRIG_WIDE void LoopHalves(...) { Loop<LaneVector>(...); }
///   ... whole_lanes ? LoopWhole(...) : LoopHalves(...)
#include "actuators/magnetics/lane_vector.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(AMBRIG_SANITIZED)
#define AMBRIG_WHOLE __attribute__((target("arch=x86-64-v4")))
#else
#define AMBRIG_WHOLE
#endif

namespace ambrig {

/// Whether this machine has registers of eight doubles.
inline bool HasWholeLanes() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(AMBRIG_SANITIZED)
  const auto has = [](bool feature) { return feature; };
  return has(__builtin_cpu_supports("avx512f")) && has(__builtin_cpu_supports("avx512vl")) &&
         has(__builtin_cpu_supports("avx512dq")) && has(__builtin_cpu_supports("avx512bw")) &&
         has(__builtin_cpu_supports("avx512cd")) && has(__builtin_cpu_supports("fma"));
#else
  return false;
#endif
}
/// Which way the hot loops go; a test switches it to see that both give the same bits.
inline bool whole_lanes = HasWholeLanes();

using EightLanes = double __attribute__((vector_size(64)));
using EightMasks = long long __attribute__((vector_size(64)));

struct WholeLaneVector {
  EightLanes v = {};
  [[gnu::always_inline]] WholeLaneVector() = default;
  [[gnu::always_inline]] WholeLaneVector(const EightLanes& lanes) : v(lanes) {}
  [[gnu::always_inline]] WholeLaneVector(double x)
      : v(EightLanes{} + x) {}  // the same in every lane
  [[gnu::always_inline]] double operator[](int j) const { return v[j]; }
  [[gnu::always_inline]] WholeLaneVector& operator+=(const WholeLaneVector& y) {
    v += y.v;
    return *this;
  }
};

AMBRIG_INLINE WholeLaneVector operator+(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v + y.v;
}
AMBRIG_INLINE WholeLaneVector operator-(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v - y.v;
}
AMBRIG_INLINE WholeLaneVector operator*(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v * y.v;
}
AMBRIG_INLINE WholeLaneVector operator*(const WholeLaneVector& x, double y) { return x.v * y; }
AMBRIG_INLINE WholeLaneVector operator/(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v / y.v;
}
AMBRIG_INLINE WholeLaneVector operator-(const WholeLaneVector& x) { return -x.v; }
AMBRIG_INLINE EightMasks operator<(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v < y.v;
}
AMBRIG_INLINE EightMasks operator==(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v == y.v;
}
AMBRIG_INLINE EightMasks operator>(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v > y.v;
}

AMBRIG_INLINE WholeLaneVector Select(const EightMasks& m, const WholeLaneVector& yes,
                                     const WholeLaneVector& no) {
  return m ? yes.v : no.v;
}
AMBRIG_INLINE WholeLaneVector Min(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v < y.v ? x.v : y.v;
}
AMBRIG_INLINE WholeLaneVector Max(const WholeLaneVector& x, const WholeLaneVector& y) {
  return x.v > y.v ? x.v : y.v;
}
AMBRIG_INLINE WholeLaneVector Abs(const WholeLaneVector& x) {
  return (EightLanes)((EightMasks)x.v & 0x7fffffffffffffffLL);
}

/// A comparison that is used more than once: g++ 12 takes it apart element by element. The
/// sign of the difference serves as well.
AMBRIG_INLINE EightMasks Below(const WholeLaneVector& x, const WholeLaneVector& y) {
  return (EightMasks)(x.v - y.v) >> 63;
}
AMBRIG_INLINE WholeLaneVector Choose(const EightMasks& m, const WholeLaneVector& yes,
                                     const WholeLaneVector& no) {
  return (EightLanes)((m & (EightMasks)yes.v) | (~m & (EightMasks)no.v));
}
AMBRIG_INLINE WholeLaneVector Only(const EightMasks& m, const WholeLaneVector& x) {
  return (EightLanes)(m & (EightMasks)x.v);
}

/// The lanes at p as one of the two vectors.
template <class V>
V LoadAs(const double* p);
template <>
[[gnu::always_inline]] inline LaneVector LoadAs<LaneVector>(const double* p) {
  return Load(p);
}
template <>
[[gnu::always_inline]] inline WholeLaneVector LoadAs<WholeLaneVector>(const double* p) {
  WholeLaneVector x;
  __builtin_memcpy(&x.v, p, sizeof x.v);
  return x;
}
AMBRIG_INLINE void Store(double* p, const WholeLaneVector& x) {
  __builtin_memcpy(p, &x.v, sizeof x.v);
}

AMBRIG_INLINE LaneVector Halves(const WholeLaneVector& x) {
  return {__builtin_shufflevector(x.v, x.v, 0, 1, 2, 3),
          __builtin_shufflevector(x.v, x.v, 4, 5, 6, 7)};
}
AMBRIG_INLINE double Sum(const WholeLaneVector& x) { return Sum(Halves(x)); }
AMBRIG_INLINE double CommonSum(const WholeLaneVector& x) { return Sum(x); }
AMBRIG_INLINE double Largest(const WholeLaneVector& x) { return Largest(Halves(x)); }
AMBRIG_INLINE WholeLaneVector Partner(const WholeLaneVector& x) {
  return __builtin_shufflevector(x.v, x.v, 1, 0, 3, 2, 5, 4, 7, 6);
}

/// What CommonSum gives of a vector.
template <class V>
using CommonOf = decltype(CommonSum(V{}));

}  // namespace ambrig
