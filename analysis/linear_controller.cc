#include "analysis/linear_controller.h"

#include "rig/rig_assembly.h"
#include "simulation/sampled/controller_setup.h"

namespace ambrig {

LinearController LineariseController(const RigParameters& rig, double Ts, double speed) {
  if (!rig.controller.IsPlainPid()) {
    const StateSpace k = MakeController(NominalRig(rig), rig.controller)->Linear(speed);
    return {k.A, k.B, Eigen::MatrixXd::Zero(k.states(), k.inputs()),
            k.C, k.D, Eigen::MatrixXd::Zero(k.outputs(), k.inputs())};
  }
  std::vector<const PidParameters*> pid;
  for (const BearingParameters& b : rig.bearings)
    pid.insert(pid.end(), b.Axes().size(), &PidOf(rig, b));
  const auto n = static_cast<Eigen::Index>(pid.size());
  LinearController c;
  c.A.setZero(3 * n, 3 * n);
  c.B_y.setZero(3 * n, n);
  c.B_r.setZero(3 * n, n);
  c.C.setZero(n, 3 * n);
  c.D_y.setZero(n, n);
  c.D_r.setZero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const PidParameters& p = *pid[static_cast<std::size_t>(k)];
    const double a = PidFilter(p, Ts), slope = (1 - a) / Ts;
    c.A.block<3, 3>(3 * k, 3 * k) << a, -slope, 0, 0, 0, 0, 0, 0, 1;
    c.B_y.block<3, 1>(3 * k, k) << slope, 1, -p.ki * Ts;
    c.B_r.block<3, 1>(3 * k, k) << 0, 0, p.ki * Ts;
    c.C.block<1, 3>(k, 3 * k) << -p.kd * a, p.kd * slope, 1;
    c.D_y(k, k) = -p.kp - p.kd * slope;
    c.D_r(k, k) = p.kp;
  }
  return c;
}

}  // namespace ambrig
