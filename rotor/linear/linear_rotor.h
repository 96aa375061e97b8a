#pragma once
/// The linear equations of a rotor at one speed, for eigenvalues, transfer functions and controller
/// design. Rigid, beam, with or without a base: always
///
///   M q'' + (D + Omega G) q' + K q = Σ_k B_k f_k,     y_k = C_k q
///
/// f_k = (fx, fy) [N] what bearing k's magnets do to the rotor (thrust: fz alone), y_k = (x, y) [m]
/// the shaft centre at its sensor's plane. Of a whole rig, with the ports filled in the order of
/// its bearings (rig/rig_assembly.h):
///
///   const Plant plant = BuildPlant(true_rig);
///   const LinearRotor linear = LinearRotorOf(plant, Omega);
///
/// Its coordinates are those of MotionState::q: x, y, z, alpha about x, beta about y, then
/// (eta_x, eta_y) of each bending mode, mass normalised, and races on mounts or a base in the order
/// of assembly. z is a free mass even where the rig has no thrust bearing: leave row and column 2
/// out then. A sampled controller, amplifiers and magnets are not in here.
/// Source: docs/theory/base_model.md section 1; docs/theory/rotor.md.
#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

namespace ambrig {

/// Forces at one plane come in by B (dofs x axes), displacements there are read by C (axes x dofs).
struct LinearPort {
  std::string name;      // of the bearing
  double z = 0;          // force plane [m]
  double sensor_z = 0;   // [m]
  Eigen::MatrixXd B, C;  // of the magnets' plane, of the sensor's plane
  Eigen::MatrixXd gap;   // displacement at the magnets' plane: of the negative stiffness
};

struct LinearRotor {
  Eigen::MatrixXd M, G, D, K;
  std::vector<std::array<int, 2>> xy;  // (x, y) pairs of displacements, for the sense of whirl
  std::vector<LinearPort> ports;       // of a rig: one per bearing
};

}  // namespace ambrig
