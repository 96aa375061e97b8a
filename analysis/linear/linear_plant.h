#pragma once
/// The plant of a rig between sampling instants as one linear system, deviations from the operating
/// point at one speed:
///
///   x = [q, q', λ, (z, y)...]   q: kept coordinates of the rotor, λ: linkages of the coils that
///                          carry, z: states of the iron, y: lags of the sensors of each bearing
///   M q'' + (D + Ω G) q' + K q = Σ B f,   λ' = v - R i,   i = I_λ λ + I_r r + I_z z,
///   f = F_λ λ + F_r r + F_z z,   z' = Z_λ λ + Z_r r + Z_z z,   τ y' = u - y
///
/// with r the shaft at the magnets and u what comes into a lag. The currents are those of the coils
/// or, for a controller's synthesis, which wants few states, the amplitudes of the axes' patterns
/// (OntoPatterns), without z. Coordinates that no bearing moves, not even through others (z without
/// a thrust bearing, races, what an opposed pair on a bench cannot reach), are left out. Source:
/// base_model.md sections 1 and 2; rotor/linear/linear_rotor.h, linear_bearing.h.
#include <Eigen/Dense>
#include <vector>

#include "analysis/linear/operating_point.h"
#include "rotor/linear/linear_rotor.h"

namespace ambrig {

/// How the coil currents of a plant are modelled.
enum class CurrentModel {
  kCoils,         // every coil by itself: exact
  kAxisPatterns,  // one current per axis, in the pattern that its force asks for
};

/// A coil that takes part in a current; its share of the pattern's linkage (1 of a coil by itself).
struct CoilShare {
  int lane = 0;
  double share = 1;
};

/// One current of the plant: a coil's, or the amplitude of an axis' pattern.
struct PlantCoil {
  std::size_t bearing = 0;
  int lane = 0;  // of the coil; of a pattern: the side of the bearing, 0 or 1
  std::vector<CoilShare> shares;
  Eigen::Index axis = 0;    // of the plant, the first of the bearing
  Eigen::VectorXd command;  // set-point per force of the bearing's axes [A/N]
};

struct LinearPlant {
  double speed = 0;             // [rad/s]
  LinearRotor rotor;            // kept coordinates only; ports: one per bearing
  std::vector<int> coordinate;  // of each kept one in MotionState::q
  std::vector<PlantCoil> coils;
  // n = 2 m + c states and those of iron and sensors; m coordinates, c coils, a controlled axes.
  Eigen::MatrixXd A;         // (n x n)
  Eigen::MatrixXd pushed;    // (n x m) rates of x by generalised forces on q
  Eigen::MatrixXd current;   // (c x n) coil currents [A]
  Eigen::MatrixXd measured;  // (c x n) the same as their sensors read them [A]
  Eigen::MatrixXd reading;   // (a x n) of the position sensors [m]
  Eigen::MatrixXd position;  // (a x n) shaft at the magnets [m]
  Eigen::MatrixXd force;     // (a x n) of the magnets on the rotor [N]

  Eigen::Index m() const { return rotor.M.rows(); }
  Eigen::Index n() const { return A.rows(); }
  Eigen::Index axes() const { return reading.rows(); }
};

/// The same with a rotor that moves as `pushed` accelerates it and by nothing else [m/s2].
LinearPlant WithDrivenRotor(LinearPlant plant);

/// Of these axes, whole bearings in ascending order; the magnets of others exert no force. Default:
/// all.
LinearPlant LinearisePlant(const OperatingPoint& point, double speed,
                           CurrentModel currents = CurrentModel::kCoils,
                           const std::vector<std::size_t>* axes = nullptr);

}  // namespace ambrig
