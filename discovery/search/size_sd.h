#pragma once
/// How well the sizes of an effect are known when the shape of its law (a frequency, a time
/// constant) is held: a slow rise tells size over time constant well and neither alone.
#include <Eigen/Dense>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// sd of the effects' parameters in coordinates, those of shape of the same effect held: 0 for rig
/// parameters and for the shapes themselves. `information`: n x n for the n free parameters, priors
/// included.
std::vector<double> SdOfSizes(const Hypothesis& h, const Eigen::MatrixXd& information);

}  // namespace ambrig
