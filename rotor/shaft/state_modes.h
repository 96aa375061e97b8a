#pragma once
/// Eigenvalues of a rotor's equations at one speed, as rotor/shaft/rotor_modes.h and
/// rotor/shaft/whole_beam_modes.h use them.
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

struct StateModes {
  Eigen::VectorXcd s;      // [1/s]
  Eigen::MatrixXcd shape;  // displacements, dofs x eigenvalues
};

/// The middle and the largest of sqrt(K_ii/M_ii) [1/s]. Supports that count as rigid stand far out:
/// what they are part of then blurs the low modes of a solver whose error is that of
/// the largest eigenvalue.
double UsualRate(const LinearRotor& rotor);
double StiffestRate(const LinearRotor& rotor);
inline constexpr double kRigidRate = 1e3;  // of the usual one

/// All eigenvalues. With rigid supports from those of 1/(s - shift), so that the low ones keep
/// their digits. @throws InputError when the mass matrix is singular.
StateModes SolveState(const LinearRotor& rotor, double speed);

/// The same eigenvalues alone, in a fraction of the time; false where they want their vectors
/// (rigid supports) or do not converge.
bool StatePoles(const LinearRotor& rotor, double speed, Eigen::VectorXcd& s);

/// Those without a frequency, rising; not those of rigid motions, which are 0.
std::vector<double> RealPoles(const Eigen::VectorXcd& s);

/// Those with a frequency, by it, at most `count`; their whirl is still to be set.
std::vector<WhirlMode> OscillatoryModes(const StateModes& state, int count);

WhirlMode MakeWhirlMode(std::complex<double> s, Eigen::VectorXcd shape);

/// (forward - backward) / (forward + backward), squared amplitudes over all planes.
double WhirlIndex(const std::vector<std::array<int, 2>>& xy, const Eigen::VectorXcd& shape);

}  // namespace ambrig
