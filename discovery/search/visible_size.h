#pragma once
/// How large an effect could be without being seen in the records of a case.
#include <string>
#include <vector>

#include "discovery/search/fit.h"
#include "discovery/search/signature_bank.h"

namespace ambrig {

/// Least size of a parameter of an effect that the records would show: three standard deviations
/// beside the rig parameters.
struct VisibleSize {
  std::string effect, target, parameter, unit;
  double size = 0;
};

/// Of every parameter of the bank's effects that `base` does not hold, smallest share of its usual
/// size first.
std::vector<VisibleSize> VisibleSizes(const CaseModel& model, const FitResult& base,
                                      double effective_sample_size, SignatureBank& bank);

}  // namespace ambrig
