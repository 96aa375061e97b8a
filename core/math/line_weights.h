#pragma once
/// Weights of points on a straight line,
/// w_k = 1/n + (z - mean)(z_k - mean)/Σ(z_k - mean)²: what the least-squares line through readings
/// at the places z_k has at z. The same weights are the shares of supports at z_k in a load of 1 at
/// z: Σ w_k = 1, Σ w_k z_k = z, of least norm where there are more than two. Equal weights where
/// all places are one.
#include <vector>

namespace ambrig {

std::vector<double> LineWeights(const std::vector<double>& places, double z);

}  // namespace ambrig
