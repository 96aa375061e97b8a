#pragma once
/// How well the parameters of a fit are known when the law itself is in doubt. The covariance of a
/// fit holds if its law does. Where it does not, every part of the records asks for another value:
/// the spread of what they ask for, beyond what noise makes of it, is what the single value leaves
/// open.
#include <vector>

#include "discovery/search/fit.h"

namespace ambrig {

/// Values that blocks of data ask for, with their information (1/variance by noise alone).
struct BlockValue {
  double value = 0, information = 0;
};

/// Variance of the values between blocks beyond noise (DerSimonian and Laird, 1986, eq. 8); 0 where
/// noise explains their spread.
double VarianceBetween(const std::vector<BlockValue>& blocks);

/// sd of the free parameters, their own units: that of the fit's covariance; where it is larger
/// that of the scores summed block by block (White, 1980), of an effect's parameter that of a law
/// whose error has 30 independent numbers; and on top, in quadrature, the spread between blocks (of
/// a rig parameter, the data's share of it, and never more than its drawing says). A block is one
/// kind of channel in a third of a record, fitted or unseen. Of an effect's parameter that acts
/// like a rig parameter, within what sensitivities err by, at least what the drawing leaves open of
/// that one. `fit` with its sensitivities; `effective_sample_size` as in FitOptions.
std::vector<double> SdUnderDoubt(const CaseModel& model, const FitResult& fit,
                                 double effective_sample_size);

}  // namespace ambrig
