#include "analysis/linear/control_plant.h"

#include <algorithm>
#include <unsupported/Eigen/MatrixFunctions>

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Typical sizes of the states, so that numbers near 1 are what is controlled.
constexpr double kSize = 1e-5, kRate = 1e3;  // [m] at a plane, [1/s]

/// Where the parts of a state stand: q (n), q' (n), currents, feedback, integrals of the current
/// loops (p each), and at the controller's pace the set-points (p).
struct Layout {
  Index n, p;
  Index current = 2 * n, feedback = current + p, integral = feedback + p, set_point = integral + p;
};

/// x <- F x + G v_set + E d, over one step of either pace.
struct Step {
  MatrixXd F, G, E;
};

/// Coils and rotor over one switching period: q, q', i and the integral of i; what a volt's impulse
/// at the mean edge does, and what constant forces on the axes and disturbances do.
struct Flow {
  MatrixXd Phi, Pulse, Gamma;
};

Flow PeriodFlow(const RigLinearization& l, double T) {
  const Index n = l.stiffness.rows(), p = l.bearing.rows(), g = l.disturbance_input.cols(),
              d = p + g, c = 2 * n + 2 * p;
  MatrixXd A = MatrixXd::Zero(c, c), U = MatrixXd::Zero(c, p), F = MatrixXd::Zero(c, d);
  A.block(0, n, n, n).setIdentity();
  A.block(n, 0, n, n) = l.stiffness + l.force * l.magnet * l.bearing;
  A.block(n, n, n, n) = l.damping;
  for (Index a = 0; a < p; ++a) {
    const AxisActuator& k = l.actuators[static_cast<std::size_t>(a)];
    const Index i = 2 * n + a;
    A.block(n, i, n, 1) = k.force * l.force.col(a);
    A(i, i) = -k.resistance / k.inductance;
    A.block(i, n, 1, n) = -k.back_emf_constant / k.inductance * l.bearing.row(a);
    A(i + p, i) = 1;
    U(i, a) = k.volts / k.inductance;
  }
  F.block(n, 0, n, p) = l.force;
  F.block(n, p, n, g) = l.disturbance_input;
  MatrixXd augmented = MatrixXd::Zero(c + d, c + d);  // a constant force, by the matrix exponential
  augmented.topLeftCorner(c, c) = A * T;
  augmented.topRightCorner(c, d) = F * T;
  const MatrixXd flow = augmented.exp();
  Flow out{flow.topLeftCorner(c, c), MatrixXd(c, p), flow.topRightCorner(c, d)};
  for (Index a = 0; a < p; ++a) {
    const double after = 1 - l.actuators[static_cast<std::size_t>(a)].edge;
    out.Pulse.col(a) = MatrixXd(A * (T * after)).exp() * U.col(a) * T;
  }
  return out;
}

/// One switching period with its current loops; input: set-points.
Step SwitchingPeriod(const RigLinearization& l, const AmplifierParameters& amplifier,
                     const Layout& at) {
  const double T = 1 / amplifier.switching_frequency,
               proportional = amplifier.kp + amplifier.ki * T;
  // samples stand at the beginnings of their parts
  const double skew = 1 / (2 * amplifier.adc_samples_per_period);
  const Flow flow = PeriodFlow(l, T);
  const Index p = at.p, m = at.set_point;
  const MatrixXd unit = MatrixXd::Identity(p, p);
  MatrixXd u = MatrixXd::Zero(p, m);
  u.middleCols(at.feedback, p) = -proportional * unit;
  u.middleCols(at.integral, p) = unit;
  MatrixXd next = MatrixXd::Zero(flow.Phi.rows(), m);
  next.leftCols(at.feedback) = flow.Phi.leftCols(at.feedback);
  next += flow.Pulse * u;
  const auto sampled = [&](const MatrixXd& end) {
    MatrixXd out = MatrixXd::Zero(m, end.cols());
    out.topRows(at.feedback) = end.topRows(at.feedback);
    out.middleRows(at.feedback, p) = end.bottomRows(p) / T - skew * end.middleRows(at.current, p);
    return out;
  };
  Step out{sampled(next), sampled(flow.Pulse * proportional), sampled(flow.Gamma)};
  out.F.block(at.feedback, at.current, p, p) += skew * unit;
  out.F.block(at.integral, at.integral, p, p).setIdentity();
  out.F.block(at.integral, at.feedback, p, p) = -amplifier.ki * T * unit;
  out.G.bottomRows(p) = amplifier.ki * T * unit;
  return out;
}

/// `times` steps with the same input.
Step Repeated(const Step& one, int times) {
  Step out{MatrixXd::Identity(one.F.rows(), one.F.cols()),
           MatrixXd::Zero(one.G.rows(), one.G.cols()), MatrixXd::Zero(one.E.rows(), one.E.cols())};
  for (int k = 0; k < times; ++k) {
    out.G = one.F * out.G + one.G;
    out.E = one.F * out.E + one.E;
    out.F = one.F * out.F;
  }
  return out;
}

VectorXd TypicalSizes(const RigLinearization& l, const Layout& at, double kp) {
  VectorXd size(at.set_point + at.p);
  for (Index q = 0; q < at.n; ++q) {
    const double reach =
        std::max(l.bearing.col(q).cwiseAbs().maxCoeff(), l.sensor.col(q).cwiseAbs().maxCoeff());
    size[q] = kSize / (reach > 0 ? reach : 1);
    size[at.n + q] = kRate * size[q];
  }
  for (Index a = 0; a < at.p; ++a) {
    const double ampere = 10 / l.actuators[static_cast<std::size_t>(a)].command;  // of ten newtons
    size[at.current + a] = size[at.feedback + a] = size[at.set_point + a] = ampere;
    size[at.integral + a] = ampere * kp;
  }
  return size;
}

/// The same plant in states that are divided by `size`.
void Scale(SampledPlant& plant, const VectorXd& size) {
  const VectorXd unit = size.cwiseInverse();
  plant.A = (unit.asDiagonal() * plant.A * size.asDiagonal()).eval();
  plant.B = (unit.asDiagonal() * plant.B).eval();
  plant.E = (unit.asDiagonal() * plant.E).eval();
  plant.C = (plant.C * size.asDiagonal()).eval();
  plant.V = (plant.V * size.asDiagonal()).eval();
  plant.G = (unit.asDiagonal() * plant.G).eval();
}

}  // namespace

SampledPlant MakeControlPlant(const RigParameters& rig, const std::vector<std::size_t>& axes,
                              double Omega, const RigParameters* controllers,
                              const ShaftWeights& weights) {
  RigLinearization l = LineariseRig(rig, controllers ? *controllers : rig, Omega, weights);
  KeepAxes(l, axes);
  const Layout at{l.stiffness.rows(), l.bearing.rows()};
  const Index m = at.set_point, p = at.p, g = l.disturbance_input.cols();
  // The set-points that the last tick left act over the whole of a controller period.
  const Step tick = Repeated(SwitchingPeriod(l, rig.amplifier, at), rig.periods_per_control());
  SampledPlant out;
  out.Ts = rig.periods_per_control() / rig.amplifier.switching_frequency;
  out.A = MatrixXd::Zero(m + p, m + p);
  out.A.topRows(m) << tick.F, tick.G;
  out.B = MatrixXd::Zero(m + p, p);
  for (Index a = 0; a < p; ++a)
    out.B(m + a, a) = 1 / l.actuators[static_cast<std::size_t>(a)].command;
  out.E = MatrixXd::Zero(m + p, p);
  out.E.topRows(m) = tick.E.leftCols(p);
  out.G = MatrixXd::Zero(m + p, g);
  out.G.topRows(m) = tick.E.rightCols(g);
  out.V = MatrixXd::Zero(g, m + p);
  out.V.leftCols(at.n) = l.performance_output;
  out.C = MatrixXd::Zero(p, m + p);
  out.C.leftCols(at.n) = l.sensor;
  Scale(out, TypicalSizes(l, at, rig.amplifier.kp));
  return out;
}

}  // namespace ambrig
