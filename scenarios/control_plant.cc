#include "scenarios/control_plant.h"

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "scenarios/coil_network.h"
#include "scenarios/rig.h"
#include "scenarios/start_state.h"

namespace ambrig {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One axis' magnet and amplifier in its own current pattern.
struct AxisActuator {
  double force = 0;        // k c0 [N/A]
  double command = 0;      // k c0 as the controller believes [N/A]
  double inductance = 0;   // [H]
  double motion = 0;       // kb [V s/m]
  double resistance = 0;   // [ohm]
  double volts = 0;        // of mean voltage per volt asked for [-]
  double edge = 0;         // mean edge of the switching period, share of it
};

/// Everything of the nominal rig that is linearised.
struct Linearisation {
  MatrixXd stiffness, damping;   // q'' = -... : d a/dq, d a/dv (n x n), signs as accelerations
  MatrixXd bearing, sensor;      // displacement of each axis per coordinate (axes x n)
  MatrixXd force;                // acceleration per force on an axis (n x axes)
  MatrixXd weighed, push;        // of the shaft's weights: outputs (rows x n), accelerations per disturbance (n x columns)
  MatrixXd magnet;               // d f / d x, axes x axes: negative stiffness [N/m]
  std::vector<AxisActuator> actuators;
};

DofVector Acceleration(const RotorModel& rotor, const MotionState& s, const DofVector& Q) {
  DofVector a{};
  double torque = 0;
  rotor.Accelerations(s, Q, 0, 0, a, &torque, false);
  return a;
}

/// Central differences of a smooth function, fourth order: round-off rules.
template <class F>
double Slope(const F& f, double h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

/// Coordinates that a force on the axes can move or that can move a plane.
std::vector<std::size_t> MovingCoordinates(const MatrixXd& planes, const MatrixXd& coupling) {
  const Eigen::Index n = planes.cols();
  std::vector<bool> on(static_cast<std::size_t>(n), false);
  for (Eigen::Index d = 0; d < n; ++d) on[static_cast<std::size_t>(d)] = planes.col(d).cwiseAbs().maxCoeff() > 0;
  for (bool more = true; more;) {
    more = false;
    for (Eigen::Index d = 0; d < n; ++d)
      for (Eigen::Index e = 0; e < n; ++e)
        if (on[static_cast<std::size_t>(d)] && !on[static_cast<std::size_t>(e)] && (coupling(d, e) != 0 || coupling(e, d) != 0))
          more = on[static_cast<std::size_t>(e)] = true;
  }
  std::vector<std::size_t> out;
  for (std::size_t d = 0; d < on.size(); ++d)
    if (on[d]) out.push_back(d);
  return out;
}

MatrixXd Pick(const MatrixXd& m, const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns) {
  MatrixXd out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = m(static_cast<Eigen::Index>(rows[r]), static_cast<Eigen::Index>(columns[c]));
  return out;
}

std::vector<std::size_t> All(Eigen::Index n) {
  std::vector<std::size_t> out(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = k;
  return out;
}

/// Weight of every coordinate in the displacement along `side` of a plane.
VectorXd RowOf(const PlaneMap& plane, std::size_t side, Eigen::Index n) {
  VectorXd row = VectorXd::Zero(n);
  for (std::size_t k = 0; k < static_cast<std::size_t>(plane.count); ++k)
    row[plane.dof[k]] += side == 0 ? plane.wx[k] : plane.wy[k];
  return row;
}

double Square(double v) { return v * v; }

/// Of the shaft's points [kg^-1/2].
double LargestGain(const BendingMode& mode) {
  double most = 0;
  for (const ShapePoint& p : mode.shape) most = std::max(most, std::abs(p.gain));
  return most;
}

AxisActuator ActuatorOf(const RigParameters& rig, std::size_t k, const BearingControl& control, const BearingPlant& b, const CoilNetwork& network,
                        std::size_t side, double operating_force) {
  // The pattern: what one newton of this axis puts into the coils, per ampere of v.
  AxisActuator a;
  const Eigen::Matrix<double, 8, 1> pattern = control.map.W.col(1 + static_cast<Eigen::Index>(side));
  const double norm = pattern.squaredNorm();
  a.force = ForceConstant(rig.bearings[k]) * control.map.c0;
  a.command = control.map.k * control.map.c0;
  std::array<double, kMaxWindings> i{}, bias{}, lambda{};
  for (int j = 0; j < control.coils; ++j) {
    i[static_cast<std::size_t>(j)] = pattern[j];
    bias[static_cast<std::size_t>(j)] = control.map.c0 * control.map.W(j, 0);
    a.resistance += b.base_resistance[j] * pattern[j] * pattern[j] / norm;
  }
  const auto along = [&](const std::array<double, kMaxWindings>& current, double at) {
    network.Linkages(current.data(), side == 0 ? at : 0, side == 0 ? 0 : at, lambda.data());
    double sum = 0;
    for (int j = 0; j < control.coils; ++j) sum += pattern[j] * lambda[static_cast<std::size_t>(j)] / norm;
    return sum;
  };
  a.inductance = along(i, 0);
  a.motion = Slope([&](double at) { return along(bias, at); }, 1e-3 * b.lanes.gap_offset[0]);
  PowerAmplifier amplifier(rig.amplifier);
  const BridgeImperfection ideal;
  const double v = operating_force / a.force;
  double duty = 0;
  for (int j = 0; j < control.coils; ++j) {
    amplifier.HoldCurrent(control.map.c0 * control.map.W(j, 0) + pattern[j] * v, b.base_resistance[j]);
    duty += amplifier.DutyFromVoltage(amplifier.integral()) * pattern[j] * pattern[j] / norm;
  }
  const auto mean = [&](double d) {
    const CoilVoltage p = amplifier.Pattern(d, ideal);
    const double T = 1 / rig.amplifier.switching_frequency, length[3] = {p.t1, p.t2 - p.t1, T - p.t2};
    double sum = 0;
    for (int q = 0; q < 3; ++q) sum += length[q] / T * (p.gain[q] * rig.amplifier.bus_voltage + p.drop[q]);
    return sum;
  };
  const double h = 1e-3;
  a.volts = (mean(duty + h) - mean(duty - h)) / (2 * h) * (amplifier.DutyFromVoltage(1) - amplifier.DutyFromVoltage(0));
  const CoilVoltage p = amplifier.Pattern(duty, ideal);
  a.edge = rig.amplifier.modulation == Modulation::kIdeal ? 0.5 : p.t2 * rig.amplifier.switching_frequency;
  return a;
}

Linearisation Linearise(const RigParameters& given, const RigParameters& controllers, double Omega, const ShaftWeights& weights) {
  RigParameters rig = given;  // nominal: no effects, no calibration
  rig.effects.clear();
  for (BearingParameters& b : rig.bearings) b.auxiliary.reset();
  Plant plant = BuildPlant(rig);
  Linearisation out;
  const auto n = static_cast<Eigen::Index>(plant.rotor.dof());
  MotionState s;
  s.Omega = Omega;
  const DofVector zero = Acceleration(plant.rotor, s, {});
  out.stiffness.resize(n, n);
  out.damping.resize(n, n);
  const auto column = [&](const DofVector& a) {
    VectorXd c(n);
    for (Eigen::Index d = 0; d < n; ++d) c[d] = a[static_cast<std::size_t>(d)] - zero[static_cast<std::size_t>(d)];
    return c;
  };
  for (Eigen::Index d = 0; d < n; ++d) {
    MotionState q = s, v = s;
    q.q[static_cast<std::size_t>(d)] = 1;
    v.v[static_cast<std::size_t>(d)] = 1;
    out.stiffness.col(d) = column(Acceleration(plant.rotor, q, {}));
    out.damping.col(d) = column(Acceleration(plant.rotor, v, {}));
  }
  std::vector<VectorXd> bearing, sensor, force, outputs, push;
  std::size_t axes = 0;
  for (const BearingParameters& b : rig.bearings) axes += b.Axes().size();
  out.magnet = MatrixXd::Zero(static_cast<Eigen::Index>(axes), static_cast<Eigen::Index>(axes));
  const auto shares = WeightShares(rig);
  const auto pushed = [&](const PlaneMap& at, std::size_t side) {
    DofVector Q{};
    at.AddForce(side == 0 ? 1 : 0, side == 0 ? 0 : 1, Q);
    return column(Acceleration(plant.rotor, s, Q));
  };
  for (const PlaneWeight& w : weights.planes) {
    const BearingParameters* b = rig.Find(w.at);
    const ShaftPlane* station = rig.FindStation(w.at);
    Require(b || station, "a plane of the rig");
    const PlaneMap at = plant.rotor.MakePlane(b ? b->z : station->z);
    for (const std::size_t side : {0U, 1U}) {
      outputs.push_back(RowOf(at, side, n) / w.position_weight);
      push.push_back(w.force_noise * pushed(at, side));
    }
  }
  for (std::size_t k = 0; weights.modes && k < rig.modes.size(); ++k) {
    const double eta = weights.modes->deflection / LargestGain(rig.modes[k]), error = 2 * weights.modes->uncertainty * Square(rig.modes[k].omega) * eta;
    for (const int side : {0, 1}) {
      const auto d = static_cast<Eigen::Index>(plant.rotor.mode_dof(k) + side);
      outputs.push_back(VectorXd::Unit(n, d) / eta);
      push.push_back(error * VectorXd::Unit(n, d));
    }
  }
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    const BearingPlant& b = plant.bearings[k];
    const BearingControl control = MakeBearingControl(rig, controllers, k, b.lanes);
    const CoilNetwork network(b.lanes);
    const std::size_t sides = rig.bearings[k].Axes().size(), first = bearing.size();
    const auto set = control.map.SetPoints(shares[k][0], sides > 1 ? shares[k][1] : 0);
    for (std::size_t side = 0; side < sides; ++side) {
      bearing.push_back(RowOf(b.plane, side, n));
      sensor.push_back(RowOf(b.sensor.map, side, n));
      force.push_back(pushed(b.plane, side));
      out.actuators.push_back(ActuatorOf(rig, k, control, b, network, side, shares[k][side]));
      for (std::size_t other = 0; other < sides; ++other)
        out.magnet(static_cast<Eigen::Index>(first + side), static_cast<Eigen::Index>(first + other)) = Slope(
            [&](double at) {
              double lambda[kMaxWindings];
              NetworkState state;
              const double x = other == 0 ? at : 0, y = other == 0 ? 0 : at;
              network.Linkages(set.data(), x, y, lambda);
              network.Solve(lambda, x, y, state);
              return side == 0 ? state.fx : state.fy;
            },
            1e-3 * b.lanes.gap_offset[0]);
    }
  }
  const auto rows = [n](const std::vector<VectorXd>& v) {
    MatrixXd m(static_cast<Eigen::Index>(v.size()), n);
    for (std::size_t k = 0; k < v.size(); ++k) m.row(static_cast<Eigen::Index>(k)) = v[k].transpose();
    return m;
  };
  out.bearing = rows(bearing);
  out.sensor = rows(sensor);
  out.force = rows(force).transpose();
  out.weighed = rows(outputs);
  out.push = rows(push).transpose();
  return out;
}

/// Coordinates and axes that take part.
void Reduce(Linearisation& l, const std::vector<std::size_t>& axes) {
  const auto all = All(l.bearing.cols());
  l.bearing = Pick(l.bearing, axes, all);
  l.sensor = Pick(l.sensor, axes, all);
  l.magnet = Pick(l.magnet, axes, axes);
  l.force = Pick(l.force, all, axes);
  std::vector<AxisActuator> actuators;
  for (const std::size_t a : axes) actuators.push_back(l.actuators[a]);
  l.actuators = actuators;
  MatrixXd planes(2 * l.bearing.rows(), l.bearing.cols());
  planes << l.bearing, l.sensor;
  MatrixXd coupling = l.stiffness.cwiseAbs() + l.damping.cwiseAbs();
  const auto keep = MovingCoordinates(planes, coupling);
  const auto rows = All(l.bearing.rows());
  l.bearing = Pick(l.bearing, rows, keep);
  l.sensor = Pick(l.sensor, rows, keep);
  l.force = Pick(l.force, keep, rows);
  l.weighed = Pick(l.weighed, All(l.weighed.rows()), keep);
  l.push = Pick(l.push, keep, All(l.push.cols()));
  l.stiffness = Pick(l.stiffness, keep, keep);
  l.damping = Pick(l.damping, keep, keep);
}

/// Typical sizes of the states, so that numbers near 1 are what is controlled.
constexpr double kSize = 1e-5, kRate = 1e3;  // [m] at a plane, [1/s]

}  // namespace

SampledPlant MakeControlPlant(const RigParameters& rig, const std::vector<std::size_t>& axes, double Omega,
                              const RigParameters* controllers, const ShaftWeights& weights) {
  Linearisation l = Linearise(rig, controllers ? *controllers : rig, Omega, weights);
  Reduce(l, axes);
  const AmplifierParameters& amplifier = rig.amplifier;
  const double T = 1 / amplifier.switching_frequency;
  const Eigen::Index n = l.stiffness.rows(), p = l.bearing.rows(), g = l.push.cols(), d = p + g;
  // Continuous: q, v, i, and the integral of i over the period.
  const Eigen::Index c = 2 * n + 2 * p;
  MatrixXd A = MatrixXd::Zero(c, c), U = MatrixXd::Zero(c, p), F = MatrixXd::Zero(c, d);
  A.block(0, n, n, n).setIdentity();
  A.block(n, 0, n, n) = l.stiffness + l.force * l.magnet * l.bearing;
  A.block(n, n, n, n) = l.damping;
  for (Eigen::Index a = 0; a < p; ++a) {
    const AxisActuator& k = l.actuators[static_cast<std::size_t>(a)];
    const Eigen::Index i = 2 * n + a;
    A.block(n, i, n, 1) = k.force * l.force.col(a);
    A(i, i) = -k.resistance / k.inductance;
    A.block(i, n, 1, n) = -k.motion / k.inductance * l.bearing.row(a);
    A(i + p, i) = 1;
    U(i, a) = k.volts / k.inductance;
  }
  F.block(n, 0, n, p) = l.force;
  F.block(n, p, n, g) = l.push;
  // Over one period: the matrix exponential, an impulse at the mean edge, a constant force.
  MatrixXd augmented = MatrixXd::Zero(c + d, c + d);
  augmented.topLeftCorner(c, c) = A * T;
  augmented.topRightCorner(c, d) = F * T;
  const MatrixXd flow = augmented.exp();
  const MatrixXd Phi = flow.topLeftCorner(c, c), Gamma = flow.topRightCorner(c, d);
  MatrixXd Pulse(c, p);
  for (Eigen::Index a = 0; a < p; ++a)
    Pulse.col(a) = MatrixXd(A * (T * (1 - l.actuators[static_cast<std::size_t>(a)].edge))).exp() * U.col(a) * T;
  // State of a period: q, v, i, feedback, integral of the current loop; input: set-point.
  const Eigen::Index m = 2 * n + 3 * p, ti = 2 * n, fb = 2 * n + p, in = 2 * n + 2 * p;
  MatrixXd u = MatrixXd::Zero(p, m), Fp = MatrixXd::Zero(m, m), Gp = MatrixXd::Zero(m, p), Ep = MatrixXd::Zero(m, d);
  const double proportional = amplifier.kp + amplifier.ki * T;
  u.block(0, fb, p, p) = -proportional * MatrixXd::Identity(p, p);
  u.block(0, in, p, p).setIdentity();
  MatrixXd next = MatrixXd::Zero(c, m);
  next.leftCols(2 * n + p) = Phi.leftCols(2 * n + p);
  next += Pulse * u;
  const double skew = 1 / (2 * amplifier.adc_samples_per_period);  // samples stand at the beginnings of their parts
  const auto finish = [&](const MatrixXd& end, MatrixXd& out) {
    out.topRows(2 * n + p) = end.topRows(2 * n + p);
    out.middleRows(fb, p) = end.bottomRows(p) / T - skew * end.middleRows(ti, p);
  };
  finish(next, Fp);
  Fp.block(fb, ti, p, p) += skew * MatrixXd::Identity(p, p);
  Fp.block(in, in, p, p).setIdentity();
  Fp.block(in, fb, p, p) = -amplifier.ki * T * MatrixXd::Identity(p, p);
  finish(Pulse * proportional, Gp);
  Gp.bottomRows(p) = amplifier.ki * T * MatrixXd::Identity(p, p);
  finish(Gamma, Ep);
  // Over a controller period: M times, the set-points that the last tick left.
  MatrixXd Fm = MatrixXd::Identity(m, m), Gm = MatrixXd::Zero(m, p), Em = MatrixXd::Zero(m, d);
  for (int k = 0; k < rig.periods_per_control(); ++k) {
    Gm = Fp * Gm + Gp;
    Em = Fp * Em + Ep;
    Fm = Fp * Fm;
  }
  SampledPlant out;
  out.Ts = T * rig.periods_per_control();
  out.A = MatrixXd::Zero(m + p, m + p);
  out.A.topLeftCorner(m, m) = Fm;
  out.A.topRightCorner(m, p) = Gm;
  out.B = MatrixXd::Zero(m + p, p);
  out.E = MatrixXd::Zero(m + p, p);
  out.E.topRows(m) = Em.leftCols(p);
  out.G = MatrixXd::Zero(m + p, g);
  out.G.topRows(m) = Em.rightCols(g);
  out.V = MatrixXd::Zero(g, m + p);
  out.V.leftCols(n) = l.weighed;
  out.C = MatrixXd::Zero(p, m + p);
  out.C.leftCols(n) = l.sensor;
  VectorXd size(m + p);
  for (Eigen::Index q = 0; q < n; ++q) {
    const double reach = std::max(l.bearing.col(q).cwiseAbs().maxCoeff(), l.sensor.col(q).cwiseAbs().maxCoeff());
    size[q] = kSize / (reach > 0 ? reach : 1);
    size[n + q] = kRate * size[q];
  }
  for (Eigen::Index a = 0; a < p; ++a) {
    const double newton = 1 / l.actuators[static_cast<std::size_t>(a)].command, ampere = 10 * newton;  // of ten newtons
    out.B(m + a, a) = newton;
    size[ti + a] = size[fb + a] = size[m + a] = ampere;
    size[in + a] = ampere * amplifier.kp;
  }
  const VectorXd unit = size.cwiseInverse();
  out.A = (unit.asDiagonal() * out.A * size.asDiagonal()).eval();
  out.B = (unit.asDiagonal() * out.B).eval();
  out.E = (unit.asDiagonal() * out.E).eval();
  out.C = (out.C * size.asDiagonal()).eval();
  out.V = (out.V * size.asDiagonal()).eval();
  out.G = (unit.asDiagonal() * out.G).eval();
  return out;
}

}  // namespace ambrig
