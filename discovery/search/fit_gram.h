#pragma once
/// Products of sensitivities and errors over the fitted records: all that a least-squares step
/// needs of them.
#include <Eigen/Dense>
#include <vector>

#include "discovery/search/fit.h"

namespace ambrig {

/// The fitted records, or those of them that the options name: unseen ones are simulated at the
/// end.
RecordSubset FittedRecords(const CaseModel& model, const FitOptions& options);

/// [J r]ᵀ[J r] over the rows of the fit records looked at.
Eigen::MatrixXd FitGram(const CaseModel& model, const RecordSubset& look, const Eigen::MatrixXd& J,
                        const std::vector<double>& r);

}  // namespace ambrig
