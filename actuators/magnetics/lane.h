#pragma once
/// One value per coil of a bearing, eight in lockstep.

namespace ambrig {

inline constexpr int kLanes = 8;

/// One value per lane, aligned for vector loads.
struct alignas(64) Lane {
  double v[kLanes] = {};
  double& operator[](int j) { return v[j]; }
  double operator[](int j) const { return v[j]; }
};

}  // namespace ambrig
