#pragma once
/// The position controller as a linear sampled system, all axes together:
///
///   x_(k+1) = A x_k + B_y y_k + B_r r_k          f_k = C x_k + D_y y_k + D_r r_k
///
/// y: readings [m], r: references [m], f: forces before clamping and excitation [N]. Of one PID
/// axis the states are (filtered derivative, last reading, integral), control/position/pid.h. Other
/// kinds bring their own linear model (control/position/position_controller.h); how references
/// enter them is left out: B_r = 0, D_r = 0.
#include <Eigen/Dense>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct LinearController {
  Eigen::MatrixXd A, B_y, B_r, C, D_y, D_r;
};

/// Of the rig's controller, sampled every Ts [s], at this spin speed [rad/s]. @throws InputError
/// when its synthesis fails
LinearController LineariseController(const RigParameters& rig, double Ts, double speed);

}  // namespace ambrig
