#pragma once
/// Rotations and reflections that map an eight-pole bearing, winding included, onto itself: pole j
/// goes to pole to[j], R turns the axes with it, and the winding either stays or changes all signs
/// (which changes no force). A distribution W of a failure set then serves the mapped set with
/// rows to[j] = [b_j, R w_j].
#include <array>
#include <vector>

#include "faulttolerance/redistribution/force_forms.h"

namespace ambrig {

struct BearingSymmetry {
  std::array<int, 8> to;
  Eigen::Matrix2d R;
};

/// At least the identity. NSNSNSNS has 16, NNSSNNSS 8.
std::vector<BearingSymmetry> FindSymmetries(const RedistributionProblem& problem);

CoilVector Mapped(const BearingSymmetry& symmetry, const CoilVector& per_coil);
DistributionMatrix Mapped(const BearingSymmetry& symmetry, const DistributionMatrix& W);
DistributionMatrix MappedBack(const BearingSymmetry& symmetry, const DistributionMatrix& W);

/// The symmetry whose image of `per_coil` comes first in lexicographic order.
const BearingSymmetry& ToCanonical(const std::vector<BearingSymmetry>& symmetries,
                                   const CoilVector& per_coil);

}  // namespace ambrig
