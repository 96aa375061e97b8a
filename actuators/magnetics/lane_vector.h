#pragma once
/// Arithmetic on a Lane as one value; only for sources that hold a hot loop.
///
/// AMBRIG_WIDE compiles a function for wider registers too and picks at load time: the same
/// operations in the same order (no contraction), hence the same bits on every machine.
///
/// Two halves of four doubles, not one vector of eight: g++ lowers comparisons and choices of
/// vectors wider than the registers element by element, which costs a factor of ten on machines
/// without 512-bit registers.
#include "actuators/magnetics/lane.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(AMBRIG_SANITIZED)
#define AMBRIG_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define AMBRIG_WIDE
#endif
#define AMBRIG_INLINE [[gnu::always_inline]] static inline

namespace ambrig {

using FourLanes = double __attribute__((vector_size(32)));
using FourMasks = long long __attribute__((vector_size(32)));

/// Eight comparisons' outcomes.
struct LaneMask {
  FourMasks a, b;
};

/// Eight lanes as one value.
struct LaneVector {
  FourLanes a = {}, b = {};
  [[gnu::always_inline]] LaneVector() = default;
  [[gnu::always_inline]] LaneVector(const FourLanes& low, const FourLanes& high)
      : a(low), b(high) {}
  [[gnu::always_inline]] LaneVector(double x)
      : a(FourLanes{} + x), b(a) {}  // the same in every lane
  [[gnu::always_inline]] double operator[](int j) const { return j < 4 ? a[j] : b[j - 4]; }
  [[gnu::always_inline]] LaneVector& operator+=(const LaneVector& y) {
    a += y.a;
    b += y.b;
    return *this;
  }
};

AMBRIG_INLINE LaneVector operator+(const LaneVector& x, const LaneVector& y) {
  return {x.a + y.a, x.b + y.b};
}
AMBRIG_INLINE LaneVector operator-(const LaneVector& x, const LaneVector& y) {
  return {x.a - y.a, x.b - y.b};
}
AMBRIG_INLINE LaneVector operator*(const LaneVector& x, const LaneVector& y) {
  return {x.a * y.a, x.b * y.b};
}
/// Of one number: without the constructor's addition, which something may wait for.
AMBRIG_INLINE LaneVector operator*(const LaneVector& x, double y) { return {x.a * y, x.b * y}; }
AMBRIG_INLINE LaneVector operator/(const LaneVector& x, const LaneVector& y) {
  return {x.a / y.a, x.b / y.b};
}
AMBRIG_INLINE LaneVector operator-(const LaneVector& x) { return {-x.a, -x.b}; }
AMBRIG_INLINE LaneMask operator<(const LaneVector& x, const LaneVector& y) {
  return {x.a < y.a, x.b < y.b};
}
AMBRIG_INLINE LaneMask operator>(const LaneVector& x, const LaneVector& y) {
  return {x.a > y.a, x.b > y.b};
}

AMBRIG_INLINE LaneMask operator==(const LaneVector& x, const LaneVector& y) {
  return {x.a == y.a, x.b == y.b};
}

AMBRIG_INLINE LaneVector Select(const LaneMask& m, const LaneVector& yes, const LaneVector& no) {
  return {m.a ? yes.a : no.a, m.b ? yes.b : no.b};
}
AMBRIG_INLINE LaneVector Min(const LaneVector& x, const LaneVector& y) {
  return Select(x < y, x, y);
}
AMBRIG_INLINE LaneVector Max(const LaneVector& x, const LaneVector& y) {
  return Select(x > y, x, y);
}
AMBRIG_INLINE LaneVector Abs(const LaneVector& x) { return Select(x < LaneVector(0.0), -x, x); }

AMBRIG_INLINE LaneMask operator&(const LaneMask& x, const LaneMask& y) {
  return {x.a & y.a, x.b & y.b};
}
AMBRIG_INLINE LaneMask operator|(const LaneMask& x, const LaneMask& y) {
  return {x.a | y.a, x.b | y.b};
}
AMBRIG_INLINE LaneMask operator~(const LaneMask& x) { return {~x.a, ~x.b}; }

/// Comparison whose outcome is used more than once (whole_lane_vector.h); no NaN, no two equal
/// infinities.
AMBRIG_INLINE LaneMask Below(const LaneVector& x, const LaneVector& y) { return x < y; }
/// Choice by such an outcome.
AMBRIG_INLINE LaneVector Choose(const LaneMask& m, const LaneVector& yes, const LaneVector& no) {
  return Select(m, yes, no);
}
/// x where the mask is set, else 0.
AMBRIG_INLINE LaneVector Only(const LaneMask& m, const LaneVector& x) {
  return {(FourLanes)(m.a & (FourMasks)x.a), (FourLanes)(m.b & (FourMasks)x.b)};
}

AMBRIG_INLINE LaneVector Load(const double* p) {
  LaneVector v;
  __builtin_memcpy(&v.a, p, sizeof v.a);
  __builtin_memcpy(&v.b, p + 4, sizeof v.b);
  return v;
}
AMBRIG_INLINE void Store(double* p, const LaneVector& v) {
  __builtin_memcpy(p, &v.a, sizeof v.a);
  __builtin_memcpy(p + 4, &v.b, sizeof v.b);
}

using TwoLanes = double __attribute__((vector_size(16)));
/// By way of memory that the compiler removes: asked for by its lanes, g++ takes the upper half
/// with a permutation of twice the latency.
AMBRIG_INLINE TwoLanes UpperHalf(const FourLanes& v) {
  TwoLanes upper;
  __builtin_memcpy(&upper, reinterpret_cast<const char*>(&v) + sizeof upper, sizeof upper);
  return upper;
}
AMBRIG_INLINE TwoLanes LowerHalf(const FourLanes& v) { return __builtin_shufflevector(v, v, 0, 1); }

/// Halves added to halves: (v0+v4) + (v2+v6) and (v1+v5) + (v3+v7).
AMBRIG_INLINE TwoLanes SumOfHalves(const LaneVector& v) {
  const FourLanes four = v.a + v.b;
  return LowerHalf(four) + UpperHalf(four);
}
AMBRIG_INLINE double Sum(const LaneVector& v) {
  const TwoLanes two = SumOfHalves(v);
  return two[0] + two[1];
}
/// The same sum for arithmetic with vectors: g++ keeps a scalar that waits in a general register,
/// six cycles away.
struct CommonLanes {
  FourLanes v;
};
AMBRIG_INLINE CommonLanes CommonSum(const LaneVector& v) {
  const TwoLanes two = SumOfHalves(v), sum = two + __builtin_shufflevector(two, two, 1, 0);
  return {FourLanes{sum[0], sum[0], sum[0], sum[0]}};
}
AMBRIG_INLINE CommonLanes operator*(const CommonLanes& x, double y) { return {x.v * y}; }
AMBRIG_INLINE CommonLanes operator-(const CommonLanes& x, const CommonLanes& y) {
  return {x.v - y.v};
}
AMBRIG_INLINE LaneVector operator*(const LaneVector& x, const CommonLanes& y) {
  return {x.a * y.v, x.b * y.v};
}
AMBRIG_INLINE double Largest(const LaneVector& v) {
  const FourLanes four = v.a > v.b ? v.a : v.b;
  const TwoLanes left = LowerHalf(four), right = UpperHalf(four), two = left > right ? left : right;
  return two[0] > two[1] ? two[0] : two[1];
}
/// Each lane's partner in a pair of neighbours.
AMBRIG_INLINE LaneVector Partner(const LaneVector& v) {
  return {__builtin_shufflevector(v.a, v.a, 1, 0, 3, 2),
          __builtin_shufflevector(v.b, v.b, 1, 0, 3, 2)};
}

}  // namespace ambrig
