#pragma once
/// Inductance matrix of a bearing's nominal circuit, and its inverse along a switching period.
#include <Eigen/Dense>

#include "fdd/measurement/period_slopes.h"

namespace ambrig {

using LinkageMatrix = Eigen::Matrix<double, kLanes, kLanes>;
using LinkageVector = Eigen::Matrix<double, kLanes, 1>;

/// L for permeances P [H]; unit rows for lanes without a coil.
LinkageMatrix InductanceOf(const LinkageModel& m, const Lane& P);

/// L^-1 from the sensed position at the start of a period to that at its end, linear between. [1/H]
struct MovingInverse {
  LinkageMatrix L0, start, change;

  MovingInverse(const LinkageModel& m, const MeasuredPeriod& in);
  /// At sample k of n.
  LinkageMatrix At(int k, int n) const { return start + (static_cast<double>(k) / n) * change; }
};

/// ∫v dt of coil j's healthy bridge over ADC sample k. [Wb]
double DrivenLinkage(const SamplingSettings& s, const MeasuredPeriod& in, int j, int k);

}  // namespace ambrig
