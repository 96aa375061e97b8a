#pragma once
/// Which errors of single coils are taken off the residuals of a search.
#include <vector>

#include "discovery/search/fit.h"

namespace ambrig {

struct CoilErrorChoice {
  std::vector<NuisanceKind> kinds;  // those of the possible ones that are believed
  double doubt =
      1;  // by which the weight of a squared error is divided where their amounts are estimated
};

/// Those of `possible` (discovery/model/coil_errors.h, rows of `model`) whose amount beside the
/// free parameters of `now` is one that a coil of this type can have: a larger one stands for
/// something that is to be named. So does what all coils of a bearing have in common, if
/// independent errors do not: their columns are then less their mean. One linear step of all of
/// them together from `now`, whose sensitivities and residual hold no error of a coil. Without
/// doubt where the amounts are then what the coils of a machine differ by, and the rig parameters
/// within their tolerances; beside an effect that is missing and resembles them they are not, and
/// are doubted by as much as makes them so, at most by what `now` leaves.
CoilErrorChoice ChooseCoilErrors(const CaseModel& model, const std::vector<NuisanceKind>& possible,
                                 const FitResult& now, double effective_sample_size);

/// The sd of the amounts of `kinds` beside the free parameters of `now`, which may do the same as
/// all coils of a bearing together [the unit of each]. `now` as above.
std::vector<double> SdOfCoilErrors(const CaseModel& model, const std::vector<NuisanceKind>& kinds,
                                   const FitResult& now, double effective_sample_size,
                                   double doubt);

}  // namespace ambrig
