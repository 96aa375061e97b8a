#pragma once
/// Modes of the closed loop: eigenvalues z of Phi as s = ln(z)/Ts, damping, whirl direction and the
/// shape of the shaft. A mode is one of the rotor when the rotor's coordinates and speeds take part
/// in it by at least 0.3 (participation: left times right eigenvector, sums to 1 over all states);
/// the others belong to current loops, filters and integrators.
/// Log decrement -2 pi Re s / Im s; whirl as in rotor/shaft/rotor_modes.h. Source: Schweitzer &
/// Maslen 2009.
#include "analysis/closed_loop.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

struct ClosedLoopMode {
  std::complex<double> s;  // [rad/s]
  double frequency = 0;    // damped [Hz]
  double zeta = 0, log_decrement = 0;
  double rotor_share = 0;  // participation of the rotor [-]
  double whirl = 0;        // (forward - backward)/(forward + backward); 0 of an axial mode
  bool lateral = true;     // false: the shaft moves along its axis only
  Eigen::VectorXcd q;      // kept coordinates of the rotor
  bool of_rotor() const { return rotor_share >= 0.3; }
  Whirl sense() const;
};

/// Of the largest |z|. An integrator that nothing reads (ki = 0) stands at z = 1 and moves nothing;
/// rounding puts it to either side, so the circle is this much wider.
inline bool IsStable(double spectral_radius) { return spectral_radius < 1 + 1e-9; }

struct ClosedLoopModes {
  double speed = 0;                   // [rad/s]
  double spectral_radius = 0;         // largest |z|
  std::vector<ClosedLoopMode> modes;  // oscillatory, by frequency
  bool stable() const { return IsStable(spectral_radius); }
};

/// All modes up to `highest` Hz (0: the controller's Nyquist frequency).
ClosedLoopModes FindModes(const OperatingPoint& point, const ClosedLoop& loop, double highest = 0);

/// Displacement (x, y) of the shaft axis at z per kept coordinate (2 x m).
Eigen::MatrixXd ShaftRows(const OperatingPoint& point, const LinearPlant& plant, double z);

/// Planes along the shaft for drawing and for the whirl sense: bearings, sensors, and between.
std::vector<double> ShaftStations(const OperatingPoint& point);

}  // namespace ambrig
