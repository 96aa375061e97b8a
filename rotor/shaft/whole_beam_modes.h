#pragma once
/// Modes of a whole beam of many nodes in a short time. The rotor is reduced to its lowest
/// undamped modes and the static shapes that those leave out where forces act
/// (residual attachment modes); each mode found there is then iterated to a solution of the whole
/// beam's own equations
///   P(s) q = (s² M + s (D + Omega G) + K) q = 0
/// by inverse iteration u = P(s)^-1 P'(s) q, s - (w'q)/(w'u), which converges quadratically.
/// Where two modes end as one, or an iteration does not end, the eigenvalues of the whole beam
/// are computed instead. Sources: MacNeal, Computers & Structures 1, 1971 (residual flexibility);
/// Ruhe, SIAM J. Numer. Anal. 10, 1973 (inverse iteration for nonlinear eigenvalue problems).
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

/// Columns (dofs x shapes): the `count` lowest modes of the symmetric parts of K and M,
/// and for each column of `forces` the static shape that they leave out.
/// @throws InputError when the masses are not positive (a support with negative added mass).
Eigen::MatrixXd ShapesOf(const LinearRotor& rotor, int count, const Eigen::MatrixXd& forces);

/// A motion that no spring feels.
bool IsRigidMotion(const LinearRotor& rotor, const Eigen::VectorXcd& shape);

/// The rotor in the coordinates of some shapes: B' M B and so on.
LinearRotor Projected(const LinearRotor& rotor, const Eigen::MatrixXd& shapes);

/// Where a beam's supports act: (x, y) of each side, dofs x forces.
Eigen::MatrixXd SupportColumns(const BeamRotor& beam);

struct WholeBeamModes {
  std::vector<WhirlMode> oscillatory;  // by damped frequency, at most as many as asked for
  std::vector<double> real;  // poles without a frequency [1/s], of the reduced rotor; rising
};

/// At most `count` modes. Rigid modes of a free rotor are in neither list.
WholeBeamModes FindWhirlModes(const LinearRotor& rotor, const Eigen::MatrixXd& shapes, double speed,
                              int count);

/// Modes of a rotor much like this one become this one's, in their order; false, and
/// unchanged, where one of them is lost.
bool ContinueModes(const LinearRotor& rotor, double speed, std::vector<WhirlMode>& modes);

/// As CriticalSpeeds, of the symmetric part of K; empty where that is not positive definite.
std::vector<CriticalSpeed> FindCriticalSpeeds(const LinearRotor& rotor,
                                              const Eigen::MatrixXd& shapes, int count);

}  // namespace ambrig
