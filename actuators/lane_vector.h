#pragma once
/// Arithmetic on a Lane as one vector value; only for sources that hold a hot loop.
///
/// AMBRIG_WIDE compiles a function for wider registers too and picks at load time: the same
/// operations in the same order (no contraction), hence the same bits on every machine.
#include "actuators/lane.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(AMBRIG_SANITIZED)
#define AMBRIG_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define AMBRIG_WIDE
#endif

namespace ambrig {

/// Eight lanes as one value; the compiler splits it over the registers that it has.
using LaneVector = double __attribute__((vector_size(kLanes * sizeof(double))));

[[gnu::always_inline]] static inline LaneVector Load(const double* p) {
  LaneVector v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
[[gnu::always_inline]] static inline void Store(double* p, const LaneVector& v) {
  __builtin_memcpy(p, &v, sizeof v);
}
/// Halves added to halves: ((v0+v4) + (v2+v6)) + ((v1+v5) + (v3+v7)).
[[gnu::always_inline]] static inline double Sum(const LaneVector& v) {
  using Four = double __attribute__((vector_size(32)));
  using Two = double __attribute__((vector_size(16)));
  const Four four = __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  const Two two = __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
  return two[0] + two[1];
}
/// Each lane's partner in a pair of neighbours.
[[gnu::always_inline]] static inline LaneVector Partner(const LaneVector& v) {
  return LaneVector{v[1], v[0], v[3], v[2], v[5], v[4], v[7], v[6]};
}

}  // namespace ambrig
