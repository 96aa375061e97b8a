#pragma once
/// What a controller is designed for: forces that it commands in, readings out, one step a
/// controller period, with the amplifiers, the sampling and every delay inside
/// (analysis/linear/control_plant.h makes it of a rig).
///
///   x_(k+1) = A x_k + B f_k + E d_k,   y_k = C x_k
///
/// f_k [N] is computed from y_k [m]; d_k [N] are forces on the rotor at the bearings, constant over
/// the period. The states are in units of their typical sizes, so that the matrices are well
/// scaled. A synthesis may also weigh the shaft itself (control/synthesis/plane_weight.h,
/// mode_weight.h): outputs
///
///   v_k = V x_k
///
/// whose cost is 1, and disturbances of size 1 that enter by G as d_k does by E; both
/// are empty when it weighs nothing there.
#include "control/linear/state_space.h"

namespace ambrig {

struct SampledPlant {
  Eigen::MatrixXd A, B, E, C;
  Eigen::MatrixXd V, G;  // (outputs x n), (n x disturbances)
  double Ts = 0;         // [s]

  StateSpace FromForce() const { return {A, B, C, Eigen::MatrixXd::Zero(C.rows(), B.cols())}; }
  StateSpace FromDisturbance() const {
    return {A, E, C, Eigen::MatrixXd::Zero(C.rows(), E.cols())};
  }
  Eigen::Index axes() const { return C.rows(); }
};

}  // namespace ambrig
