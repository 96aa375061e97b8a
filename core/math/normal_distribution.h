#pragma once
/// The distribution function of a normal deviate, and its inverse.

namespace ambrig {

/// Phi(z).
double NormalProbability(double z);
/// z with Phi(z) = p, 0 < p < 1; error below 1e-12.
double NormalQuantile(double p);

}  // namespace ambrig
