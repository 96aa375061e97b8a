#pragma once
/// The plant of a rig between sampling instants as one linear system, deviations from the operating
/// point at one speed:
///
///   x = [q, q', λ]      q: kept coordinates of the rotor, λ: linkages of the coils that carry
///   M q'' + (D + Ω G) q' + K q = Σ B f,   λ' = v - R i,   i = I_λ λ + I_r r,   f = F_λ λ + F_r r
///
/// with r the shaft at the magnets. Coordinates that no bearing moves, not even through others (z
/// without a thrust bearing, races, what an opposed pair on a bench cannot reach), are left out.
/// Source: base_model.md sections 1 and 2; rotor/motion/linear_rotor.h, linear_bearing.h.
#include <Eigen/Dense>
#include <vector>

#include "analysis/operating_point.h"
#include "rotor/motion/linear_rotor.h"

namespace ambrig {

struct PlantCoil {
  std::size_t bearing = 0;
  int lane = 0;
};

struct LinearPlant {
  double speed = 0;             // [rad/s]
  LinearRotor rotor;            // kept coordinates only; ports: one per bearing
  std::vector<int> coordinate;  // of each kept one in MotionState::q
  std::vector<PlantCoil> coils;
  // n = 2 m + c states; m coordinates, c coils, a controlled axes.
  Eigen::MatrixXd A;         // (n x n)
  Eigen::MatrixXd pushed;    // (n x m) rates of x by generalised forces on q
  Eigen::MatrixXd current;   // (c x n) coil currents [A]
  Eigen::MatrixXd reading;   // (a x n) shaft at the sensors [m]
  Eigen::MatrixXd position;  // (a x n) shaft at the magnets [m]
  Eigen::MatrixXd force;     // (a x n) of the magnets on the rotor [N]

  Eigen::Index m() const { return rotor.M.rows(); }
  Eigen::Index n() const { return A.rows(); }
  Eigen::Index axes() const { return reading.rows(); }
};

/// The same with a rotor that moves as `pushed` accelerates it and by nothing else [m/s2].
LinearPlant WithDrivenRotor(LinearPlant plant);

LinearPlant LinearisePlant(const OperatingPoint& point, double speed);

}  // namespace ambrig
