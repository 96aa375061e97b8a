#pragma once
/// Linear rotor dynamics: modes, Campbell data, critical speeds, unbalance response.
/// Free or pinned modes of one plane solve K phi = w² M phi. At speed Omega the whole rotor
///   M q'' + (D + Omega G) q' + K q = f
/// has eigenvalues s = -zeta wn ± i wd; log decrement 2 pi zeta / sqrt(1 - zeta²). A mode's motion
/// Re(q e^{st}) turns forward with amplitude |x + i y|/2 and backward with |x - i y|/2 at each
/// plane. Undamped critical speeds need no iteration: q = Re(Q e^{i Omega t}) gives
///   K Q = Omega² (M - i G) Q
/// solved for 1/Omega² with the Cholesky factor of K (direct synchronous method). Units SI, rad/s.
#include <complex>
#include <vector>

#include "rotor/shaft/beam.h"

namespace ambrig {

/// Mass-normalised modes of one bending plane (phi' M phi = 1), rows as plane dofs (w, psi) per
/// node.
struct PlaneModes {
  Eigen::VectorXd omega;
  Eigen::MatrixXd shape;
};

/// The first `count` bending modes of the shaft without supports.
PlaneModes FreeModes(const BeamRotor& rotor, int count);

/// The first modes with some plane dofs held (2 i: displacement of node i, 2 i + 1: its rotation).
PlaneModes HeldModes(const BeamRotor& rotor, const std::vector<int>& held_dofs, int count);

enum class Whirl { kForward, kBackward, kMixed };

struct WhirlMode {
  std::complex<double> s;  // eigenvalue, Im > 0
  double omega_n = 0;      // |s|
  double omega_d = 0;      // Im s
  double zeta = 0;
  double log_decrement = 0;
  // (forward - backward) / (forward + backward), squared amplitudes of all planes
  double whirl = 0;
  Eigen::VectorXcd shape;
  Whirl sense() const;  // mixed: |whirl| < 0.1, among them every planar motion
};

/// Oscillatory modes at one speed, by damped frequency, at most `count`. At rest the modes of an
/// isotropic rotor come in pairs of one frequency and their sense is arbitrary.
std::vector<WhirlMode> WhirlModes(const LinearRotor& rotor, double speed, int count);

struct CampbellRow {
  double speed = 0;
  std::vector<WhirlMode> modes;
};
std::vector<CampbellRow> Campbell(const LinearRotor& rotor, const std::vector<double>& speeds,
                                  int count);

struct CriticalSpeed {
  double speed = 0;
  double whirl = 0;  // as WhirlMode
  Eigen::VectorXcd shape;
};

/// Undamped critical speeds in rising order, damping ignored. Requires a symmetric, positive
/// definite K.
std::vector<CriticalSpeed> CriticalSpeeds(const LinearRotor& rotor, int count);

struct CriticalMapRow {
  double stiffness = 0;  // of every support, isotropic [N/m]
  std::vector<CriticalSpeed> speeds;
};
/// Undamped critical speed map: the supports' planes with one common stiffness after the other.
std::vector<CriticalMapRow> CriticalSpeedMap(const BeamRotor& rotor,
                                             const std::vector<double>& stiffnesses, int count);

/// Mass times eccentricity at a node [kg m], at an angle from x at t = 0.
struct Unbalance {
  int node = 0;
  double magnitude = 0;
  double phase = 0;
};

/// Complex amplitudes Q of q = Re(Q e^{i Omega t}).
Eigen::VectorXcd UnbalanceResponse(const LinearRotor& rotor,
                                   const std::vector<Unbalance>& unbalances, double speed);

/// Half axes of the ellipse x = Re(X e^{it}), y = Re(Y e^{it}); minor is negative for backward
/// whirl.
struct OrbitAxes {
  double major = 0, minor = 0;
};
OrbitAxes AxesOfOrbit(std::complex<double> x, std::complex<double> y);

/// The rotor in the coordinates of its `count` lowest undamped modes at rest, for sweeps over many
/// speeds; `shape` of its modes is in modal coordinates, q = basis * shape. No `xy` pairs are lost:
/// the whirl sense is still taken in `rotor.xy` through the basis.
struct TruncatedRotor {
  LinearRotor modal;
  Eigen::MatrixXd basis;
};
TruncatedRotor Truncate(const LinearRotor& rotor, int count);
std::vector<WhirlMode> WhirlModes(const TruncatedRotor& rotor, const LinearRotor& full,
                                  double speed, int count);

}  // namespace ambrig
