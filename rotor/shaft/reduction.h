#pragma once
/// A beam rotor reduced to its rigid body and the first n bending modes phi_k of the free shaft,
/// mass-normalised, one amplitude per plane. Displacement of the shaft centre at z, with the arm
/// a = z - z_com:
///   x(z) = x + a beta + sum phi_k(z) eta_xk,     y(z) = y - a alpha + sum phi_k(z) eta_yk
/// With forces f at planes z_j, arms a_j, and slope psi_k of mode k (section rotation), J_00 = Ip:
///   m x'' = sum fx                               m y'' = sum fy
///   It alpha'' + Omega (Ip beta'  + sum J_0k eta_xk') = -sum a fy
///   It beta''  - Omega (Ip alpha' - sum J_0k eta_yk') =  sum a fx
///   eta_xk'' + 2 zeta_k w_k eta_xk' + w_k² eta_xk + Omega g_xk = sum phi_k fx
///   eta_yk'' + 2 zeta_k w_k eta_yk' + w_k² eta_yk - Omega g_yk = sum phi_k fy
///   g_xk = -J_k0 alpha' + sum J_kl eta_yl',      g_yk = J_k0 beta' + sum J_kl eta_xl'
/// Free-free modes are orthogonal to the rigid ones, so mass and stiffness stay diagonal; only the
/// gyroscopic J couples (kept in full). With n = 0 this is the rigid rotor of base_model.md. Units
/// SI.
#include <Eigen/Dense>
#include <vector>

#include "rotor/shaft/beam.h"

namespace ambrig {

struct ReducedRotor {
  double mass = 0, inertia_transverse = 0, inertia_polar = 0;
  double z_com = 0;  // centre of mass on the beam's axis; bearing planes there are z - z_com
  std::vector<double> omega;  // bending modes [rad/s]
  std::vector<double> zeta;   // damping ratios
  Eigen::MatrixXd J;          // (1 + n)²: index 0 tilt [kg m2], k mode k (per sqrt(kg) each)
  // Mode shapes by the elements' own interpolation.
  std::vector<double> node_z;
  std::vector<ShaftElement> elements;
  BeamTheory theory;
  Eigen::MatrixXd shape;  // plane dofs (w, psi) per node, one column per mode
  int modes() const { return static_cast<int>(omega.size()); }
};

/// What a force or sensor at one plane needs: displacement = centre + arm * tilt + phi . eta.
struct ModalStation {
  double arm = 0;         // z - z_com [m]
  Eigen::VectorXd phi;    // displacement of each mode [1/sqrt(kg)]
  Eigen::VectorXd slope;  // section rotation of each mode [1/(m sqrt(kg))]
};

/// One damping ratio per mode; a single one serves all modes. The shaft's Rayleigh damping is
/// added. With `stations` [m on the beam's axis] their residual modes
/// (rotor/shaft/residual_modes.h) follow the bending modes, damped as the last of them.
ReducedRotor Reduce(const BeamRotor& rotor, int modes, const std::vector<double>& damping_ratios,
                    const std::vector<double>& stations = {});

/// At any z on the beam's axis; beyond an end the shaft is continued straight.
ModalStation StationAt(const ReducedRotor& rotor, double z);

/// Coordinates (x, y, alpha, beta, eta_x1.., eta_y1..) as a linear rotor without supports.
LinearRotor Linear(const ReducedRotor& rotor);

/// Displacement at a station = row 0 (x), row 1 (y) times the coordinates; the transpose takes
/// forces in.
Eigen::MatrixXd StationRows(const ModalStation& station);

/// Adds a spring and damper to ground at its plane.
void AddSupport(const ReducedRotor& rotor, const SpringSupport& support, LinearRotor& linear);

}  // namespace ambrig
