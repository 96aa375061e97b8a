#pragma once
/// The first four of eight lanes, for bearings that have no more coils, with the interface and the
/// bits of LaneVector.
#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

struct FirstLanes {
  FourLanes v = {};
  [[gnu::always_inline]] FirstLanes() = default;
  [[gnu::always_inline]] FirstLanes(const FourLanes& lanes) : v(lanes) {}
  [[gnu::always_inline]] FirstLanes(double x) : v(FourLanes{} + x) {}  // the same in every lane
  [[gnu::always_inline]] FirstLanes& operator+=(const FirstLanes& y) {
    v += y.v;
    return *this;
  }
};

AMBRIG_INLINE FirstLanes operator+(const FirstLanes& x, const FirstLanes& y) { return x.v + y.v; }
AMBRIG_INLINE FirstLanes operator-(const FirstLanes& x, const FirstLanes& y) { return x.v - y.v; }
AMBRIG_INLINE FirstLanes operator-(const FirstLanes& x) { return -x.v; }
AMBRIG_INLINE FirstLanes operator*(const FirstLanes& x, const FirstLanes& y) { return x.v * y.v; }
AMBRIG_INLINE FirstLanes operator*(const FirstLanes& x, double y) { return x.v * y; }
AMBRIG_INLINE FourMasks operator<(const FirstLanes& x, const FirstLanes& y) { return x.v < y.v; }
AMBRIG_INLINE FourMasks operator>(const FirstLanes& x, const FirstLanes& y) { return x.v > y.v; }
AMBRIG_INLINE FourMasks operator==(const FirstLanes& x, const FirstLanes& y) { return x.v == y.v; }

AMBRIG_INLINE FirstLanes Select(const FourMasks& m, const FirstLanes& yes, const FirstLanes& no) {
  return m ? yes.v : no.v;
}
AMBRIG_INLINE FirstLanes Min(const FirstLanes& x, const FirstLanes& y) {
  return x.v < y.v ? x.v : y.v;
}
AMBRIG_INLINE FirstLanes Max(const FirstLanes& x, const FirstLanes& y) {
  return x.v > y.v ? x.v : y.v;
}
AMBRIG_INLINE FirstLanes Partner(const FirstLanes& x) {
  return __builtin_shufflevector(x.v, x.v, 1, 0, 3, 2);
}
AMBRIG_INLINE double Sum(const FirstLanes& x) { return Sum(LaneVector(x.v, FourLanes{})); }
AMBRIG_INLINE double Largest(const FirstLanes& x) { return Largest(LaneVector(x.v, x.v)); }

template <>
[[gnu::always_inline]] inline FirstLanes LoadAs<FirstLanes>(const double* p) {
  FirstLanes x;
  __builtin_memcpy(&x.v, p, sizeof x.v);
  return x;
}
AMBRIG_INLINE void Store(double* p, const FirstLanes& x) { __builtin_memcpy(p, &x.v, sizeof x.v); }

}  // namespace ambrig
