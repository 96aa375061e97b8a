#pragma once
/// Sensitivities of the residual to the free parameters, by differences, in coordinates where one
/// unit is one prior sd (or one natural step).
#include <Eigen/Dense>

#include "discovery/model/residual.h"

namespace ambrig {

/// Column j: d(prediction/floor)/d(coordinate j), by one-sided differences of `fraction` of a step.
/// Coarse predictions are enough for that. Hypotheses that fall out of control leave a zero column.
/// With a `look` the rows of its records only; the others are zero.
Eigen::MatrixXd Jacobian(const CaseModel& model, const Hypothesis& h,
                         const std::vector<std::size_t>& parameters, double fraction = 0.3,
                         const QuickLook* look = nullptr);

}  // namespace ambrig
