#pragma once
/// Sensitivities of the residual to the free parameters, by differences, in coordinates where one
/// unit is one prior sd (or one natural step).
#include <Eigen/Dense>

#include "discovery/model/residual.h"

namespace ambrig {

/// Two-sided differences take the smaller of the forward and the backward one in each row, zero
/// where they differ in sign: a prediction jumps where a switching edge passes a sample, on one
/// side only.
enum class DifferenceSides { kOneSided, kTwoSided };

/// Rows of the model x `parameters` [-]. Column j: d(prediction/floor)/d(coordinate j), by
/// differences of `fraction` of a step. Coarse predictions are enough for that. Hypotheses that
/// fall out of control leave a zero column. With a `look` the rows of its records only; the others
/// are zero.
Eigen::MatrixXd Jacobian(const CaseModel& model, const Hypothesis& h,
                         const std::vector<std::size_t>& parameters, double fraction = 0.3,
                         const RecordSubset* look = nullptr,
                         DifferenceSides differences = DifferenceSides::kOneSided);

}  // namespace ambrig
