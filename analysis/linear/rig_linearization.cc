#include "analysis/linear/rig_linearization.h"

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/coil_network.h"
#include "rig/nominal_control.h"
#include "rig/rig_assembly.h"
#include "rotor/motion/linear_rotor.h"

namespace ambrig {

namespace {

using Eigen::MatrixXd;

/// Central differences of a smooth function, fourth order: round-off rules.
template <class F>
double Slope(const F& f, double h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

/// Coordinates that a force on the axes can move or that can move a plane.
std::vector<std::size_t> MovingCoordinates(const MatrixXd& planes, const MatrixXd& coupling) {
  const Eigen::Index n = planes.cols();
  std::vector<bool> on(static_cast<std::size_t>(n), false);
  for (Eigen::Index d = 0; d < n; ++d)
    on[static_cast<std::size_t>(d)] = planes.col(d).cwiseAbs().maxCoeff() > 0;
  for (bool more = true; more;) {
    more = false;
    for (Eigen::Index d = 0; d < n; ++d)
      for (Eigen::Index e = 0; e < n; ++e)
        if (on[static_cast<std::size_t>(d)] && !on[static_cast<std::size_t>(e)] &&
            (coupling(d, e) != 0 || coupling(e, d) != 0))
          more = on[static_cast<std::size_t>(e)] = true;
  }
  std::vector<std::size_t> out;
  for (std::size_t d = 0; d < on.size(); ++d)
    if (on[d]) out.push_back(d);
  return out;
}

/// Of the shaft's points [kg^-1/2].
double LargestGain(const BendingMode& mode) {
  double most = 0;
  for (const ShapePoint& p : mode.shape) most = std::max(most, std::abs(p.gain));
  return most;
}

AxisActuator ActuatorOf(const RigParameters& rig, std::size_t k, const BearingControl& control,
                        const BearingPlant& b, const CoilNetwork& network, std::size_t side,
                        double operating_force) {
  // The pattern: what one newton of this axis puts into the coils, per ampere of v.
  AxisActuator a;
  const Eigen::Matrix<double, 8, 1> pattern =
      control.map.W.col(1 + static_cast<Eigen::Index>(side));
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
    for (int j = 0; j < control.coils; ++j)
      sum += pattern[j] * lambda[static_cast<std::size_t>(j)] / norm;
    return sum;
  };
  a.inductance = along(i, 0);
  a.back_emf_constant =
      Slope([&](double at) { return along(bias, at); }, 1e-3 * b.lanes.gap_offset[0]);
  CurrentRegulator regulator = control.regulator[0];
  const double v = operating_force / a.force;
  double duty = 0;
  for (int j = 0; j < control.coils; ++j) {
    regulator.HoldCurrent(control.map.c0 * control.map.W(j, 0) + pattern[j] * v,
                          b.base_resistance[j]);
    duty += regulator.DutyFromVoltage(regulator.integral()) * pattern[j] * pattern[j] / norm;
  }
  const auto mean = [&](double d) {
    const CoilVoltage p = IdealBridgeVoltage(rig.amplifier, d);
    const double T = 1 / rig.amplifier.switching_frequency,
                 length[3] = {p.t1, p.t2 - p.t1, T - p.t2};
    double sum = 0;
    for (int q = 0; q < 3; ++q)
      sum += length[q] / T * (p.gain[q] * rig.amplifier.bus_voltage + p.drop[q]);
    return sum;
  };
  const double h = 1e-3;
  a.volts = (mean(duty + h) - mean(duty - h)) / (2 * h) *
            (regulator.DutyFromVoltage(1) - regulator.DutyFromVoltage(0));
  const CoilVoltage p = IdealBridgeVoltage(rig.amplifier, duty);
  a.edge = rig.amplifier.modulation == Modulation::kIdeal
               ? 0.5
               : p.t2 * rig.amplifier.switching_frequency;
  return a;
}

/// Outputs and disturbances of the planes and modes that are weighed.
void AddWeights(const RigParameters& rig, const RotorModel& rotor, const ShaftWeights& weights,
                const MatrixXd& inverse_mass, RigLinearization& out) {
  const Eigen::Index n = inverse_mass.rows();
  const auto planes = static_cast<Eigen::Index>(weights.planes.size());
  const auto modes = static_cast<Eigen::Index>(weights.modes ? rig.modes.size() : 0);
  out.performance_output = MatrixXd::Zero(2 * (planes + modes), n);
  out.disturbance_input = MatrixXd::Zero(n, 2 * (planes + modes));
  for (Eigen::Index k = 0; k < planes; ++k) {
    const PlaneWeight& w = weights.planes[static_cast<std::size_t>(k)];
    const BearingParameters* b = rig.Find(w.at);
    const ShaftPlane* station = rig.FindStation(w.at);
    Require(b || station, "a plane of the rig");
    const PlaneMap at = rotor.MakePlane(b ? b->z : station->z);
    out.performance_output.middleRows(2 * k, 2) = PlaneRows(rotor, at) / w.position_weight;
    out.disturbance_input.middleCols(2 * k, 2) =
        w.force_noise * inverse_mass * ForceColumns(rotor, at);
  }
  for (Eigen::Index k = 0; k < modes; ++k) {
    const BendingMode& mode = rig.modes[static_cast<std::size_t>(k)];
    const double eta = weights.modes->deflection / LargestGain(mode);
    const double error = 2 * weights.modes->uncertainty * mode.omega * mode.omega * eta;
    for (Eigen::Index side = 0; side < 2; ++side) {
      const Eigen::Index row = 2 * (planes + k) + side,
                         d = rotor.mode_dof(static_cast<std::size_t>(k)) + side;
      out.performance_output(row, d) = 1 / eta;
      out.disturbance_input(d, row) = error;
    }
  }
}

/// d f / d x of a bearing at set-points `set`, axes x axes. [N/m]
MatrixXd NegativeStiffness(const CoilNetwork& network, const CoilVector& set, Eigen::Index axes,
                           double gap) {
  MatrixXd out(axes, axes);
  for (Eigen::Index side = 0; side < axes; ++side)
    for (Eigen::Index other = 0; other < axes; ++other)
      out(side, other) = Slope(
          [&](double at) {
            double lambda[kMaxWindings];
            NetworkState state;
            const double x = other == 0 ? at : 0, y = other == 0 ? 0 : at;
            network.Linkages(set.data(), x, y, lambda);
            network.Solve(lambda, x, y, state);
            return side == 0 ? state.fx : state.fy;
          },
          1e-3 * gap);
  return out;
}

}  // namespace

RigLinearization LineariseRig(const RigParameters& given, const RigParameters& controllers,
                              double Omega, const ShaftWeights& weights) {
  RigParameters rig = given;  // nominal: no effects, no calibration
  rig.effects.clear();
  for (BearingParameters& b : rig.bearings) b.auxiliary.reset();
  const Plant plant = BuildPlant(TrueRig::AsDrawn(NominalRig(rig)));
  const LinearRotor rotor = LinearRotorOf(plant, Omega);
  const Eigen::Index n = rotor.M.rows();
  // no base: M is diagonal
  const MatrixXd inverse_mass = rotor.M.diagonal().cwiseInverse().asDiagonal();
  RigLinearization out;
  out.stiffness = -inverse_mass * rotor.K;
  out.damping = -inverse_mass * (rotor.D + Omega * rotor.G);
  Eigen::Index axes = 0, first = 0;
  for (const LinearPort& port : rotor.ports) axes += port.gap.rows();
  out.bearing.resize(axes, n);
  out.sensor.resize(axes, n);
  out.force.resize(n, axes);
  out.magnet = MatrixXd::Zero(axes, axes);
  const NominalRig nominal(controllers);
  const auto shares = WeightShares(rig);
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    const LinearPort& port = rotor.ports[k];
    const Eigen::Index sides = port.gap.rows();
    out.bearing.middleRows(first, sides) = port.gap;
    out.sensor.middleRows(first, sides) = port.C;
    out.force.middleCols(first, sides) = inverse_mass * port.B;
    const BearingPlant& b = plant.bearings[k];
    const BearingControl control = MakeBearingControl(nominal, k);
    const CoilNetwork network(b.lanes);
    for (Eigen::Index side = 0; side < sides; ++side)
      out.actuators.push_back(ActuatorOf(rig, k, control, b, network,
                                         static_cast<std::size_t>(side),
                                         shares[k][static_cast<std::size_t>(side)]));
    const auto set = control.map.SetPoints(shares[k][0], sides > 1 ? shares[k][1] : 0);
    out.magnet.block(first, first, sides, sides) =
        NegativeStiffness(network, set, sides, b.lanes.gap_offset[0]);
    first += sides;
  }
  AddWeights(rig, plant.rotor, weights, inverse_mass, out);
  return out;
}

void KeepAxes(RigLinearization& l, const std::vector<std::size_t>& axes) {
  const auto all = Eigen::all;
  std::vector<AxisActuator> actuators;
  for (const std::size_t a : axes) actuators.push_back(l.actuators[a]);
  l.actuators = actuators;
  MatrixXd planes(2 * axes.size(), l.bearing.cols());
  planes << l.bearing(axes, all), l.sensor(axes, all);
  const auto keep = MovingCoordinates(planes, l.stiffness.cwiseAbs() + l.damping.cwiseAbs());
  l.magnet = l.magnet(axes, axes).eval();
  l.bearing = l.bearing(axes, keep).eval();
  l.sensor = l.sensor(axes, keep).eval();
  l.force = l.force(keep, axes).eval();
  l.performance_output = l.performance_output(all, keep).eval();
  l.disturbance_input = l.disturbance_input(keep, all).eval();
  l.stiffness = l.stiffness(keep, keep).eval();
  l.damping = l.damping(keep, keep).eval();
}

}  // namespace ambrig
