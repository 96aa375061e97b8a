#include "analysis/linear/linear_plant.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/index.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Coordinates that a bearing moves, directly or through the rotor's matrices, in rising order.
std::vector<int> Moved(const LinearRotor& r, double speed) {
  const Index n = r.M.rows();
  std::vector<bool> moved(static_cast<std::size_t>(n), false);
  const auto tiny = [](double w) { return std::abs(w) < 1e-12; };
  for (const LinearPort& p : r.ports)
    for (Index d = 0; d < n; ++d)
      if (!p.B.row(d).isZero(1e-12)) moved[static_cast<std::size_t>(d)] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (Index d = 0; d < n; ++d)
      for (Index e = 0; e < n; ++e) {
        if (moved[static_cast<std::size_t>(d)] || !moved[static_cast<std::size_t>(e)] || d == e)
          continue;
        if (tiny(r.M(d, e)) && tiny(r.K(d, e)) && tiny(r.D(d, e) + speed * r.G(d, e))) continue;
        moved[static_cast<std::size_t>(d)] = grown = true;
      }
  }
  std::vector<int> kept;
  for (Index d = 0; d < n; ++d)
    if (moved[static_cast<std::size_t>(d)]) kept.push_back(static_cast<int>(d));
  return kept;
}

LinearRotor Restrict(const LinearRotor& r, const std::vector<int>& kept) {
  LinearRotor out;
  out.M = r.M(kept, kept);
  out.G = r.G(kept, kept);
  out.D = r.D(kept, kept);
  out.K = r.K(kept, kept);
  for (const auto& [x, y] : r.xy) {
    const auto at_x = std::find(kept.begin(), kept.end(), x),
               at_y = std::find(kept.begin(), kept.end(), y);
    if (at_x != kept.end() && at_y != kept.end())
      out.xy.push_back(
          {static_cast<int>(at_x - kept.begin()), static_cast<int>(at_y - kept.begin())});
  }
  for (const LinearPort& p : r.ports) {
    LinearPort port = p;
    port.B = p.B(kept, Eigen::all);
    port.C = p.C(Eigen::all, kept);
    port.gap = p.gap(Eigen::all, kept);
    out.ports.push_back(port);
  }
  return out;
}

/// One bearing of the plant: its magnets in the currents chosen, and what those currents are.
struct BearingPart {
  LinearBearing magnets;
  std::vector<PlantCoil> currents;
  LinearSensor sensor;
};

/// Set-points of a bearing's coils per force of its axes (coils that carry x axes) [A/N]; zero
/// where a set-point is at its limit.
MatrixXd SetPointsPerForce(const OperatingPoint& point, std::size_t k) {
  const CurrentMap& map = point.control()[k].map;
  const std::vector<int>& coils = point.bearings[k].coils;
  MatrixXd out =
      MatrixXd::Zero(static_cast<Index>(coils.size()), static_cast<Index>(point.AxisCount(k)));
  for (Index row = 0; row < out.rows(); ++row) {
    const int lane = coils[static_cast<std::size_t>(row)];
    if (!point.coils[k][static_cast<std::size_t>(lane)].commanded) continue;
    for (Index side = 0; side < out.cols(); ++side)
      out(row, side) = map.W(lane, 1 + side) / (map.k * map.c0);
  }
  return out;
}

BearingPart PartOf(const OperatingPoint& point, std::size_t k, CurrentModel currents) {
  const MatrixXd set = SetPointsPerForce(point, k);
  const LinearBearing& exact = point.bearings[k];
  BearingPart out;
  out.sensor = point.sensors[k];
  if (currents == CurrentModel::kCoils) {
    out.magnets = exact;
    for (Index j = 0; j < set.rows(); ++j) {
      const int lane = exact.coils[static_cast<std::size_t>(j)];
      out.currents.push_back({k, lane, {{lane, 1}}, 0, set.row(j)});
    }
    return out;
  }
  const CurrentMap& map = point.control()[k].map;
  const MatrixXd pattern = set * (map.k * map.c0), along = PatternInverse(pattern);
  out.magnets = OntoPatterns(exact, pattern);
  for (Index side = 0; side < pattern.cols(); ++side) {
    PlantCoil c{k, static_cast<int>(side), {}, 0, VectorXd::Zero(pattern.cols())};
    for (Index j = 0; j < pattern.rows(); ++j)
      if (pattern(j, side) != 0)
        c.shares.push_back(
            {exact.coils[static_cast<std::size_t>(j)], along(side, j) * pattern(j, side)});
    c.command(side) = 1 / (map.k * map.c0);
    out.currents.push_back(c);
  }
  return out;
}

/// Bearings of these axes, ascending.
std::vector<std::size_t> BearingsOf(const OperatingPoint& point,
                                    const std::vector<std::size_t>* axes) {
  std::vector<std::size_t> out(point.bearings.size());
  std::iota(out.begin(), out.end(), 0);
  if (!axes) return out;
  std::vector<std::size_t> expected;
  std::erase_if(out, [&](std::size_t k) {
    return std::find(axes->begin(), axes->end(), point.FirstAxis(k)) == axes->end();
  });
  for (const std::size_t k : out)
    for (std::size_t side = 0; side < point.AxisCount(k); ++side)
      expected.push_back(point.FirstAxis(k) + side);
  Require(expected == *axes, "whole bearings, in ascending order");
  return out;
}

/// Sizes and zeros of a plant whose rotor and currents are known; `hidden`: states of iron and
/// sensors.
void Resize(LinearPlant& p, Index hidden) {
  const Index m = p.rotor.M.rows(), c = static_cast<Index>(p.coils.size()), n = 2 * m + c + hidden;
  Index axes = 0;
  for (const LinearPort& port : p.rotor.ports) axes += port.C.rows();
  p.A.setZero(n, n);
  p.pushed.setZero(n, m);
  for (MatrixXd* rows : {&p.current, &p.measured}) rows->setZero(c, n);
  for (MatrixXd* rows : {&p.reading, &p.position, &p.force}) rows->setZero(axes, n);
}

/// Where the parts of one bearing stand in a plant.
struct PartPlace {
  Index coil = 0, axis = 0;  // the first of its coils, of its axes
  Index state = 0;           // the first of its hidden states
};

/// Currents, forces and states of the iron.
void PlaceMagnets(const LinearBearing& b, const LinearPort& port, const PartPlace& at,
                  LinearPlant& p) {
  const Index m = p.m(), nc = b.I_lambda.rows(), na = port.C.rows(), s = b.states(),
              first = 2 * m + at.coil;
  const auto fill = [&](Eigen::Ref<MatrixXd> rows, const MatrixXd& of_lambda, const MatrixXd& of_r,
                        const MatrixXd& of_z) {
    rows.leftCols(m) = of_r.leftCols(na) * port.gap;
    rows.middleCols(first, nc) = of_lambda;
    rows.middleCols(at.state, s) = of_z;
  };
  fill(p.current.middleRows(at.coil, nc), b.I_lambda, b.I_r, b.I_z);
  fill(p.force.middleRows(at.axis, na), b.F_lambda.topRows(na), b.F_r.topRows(na),
       b.F_z.topRows(na));
  fill(p.A.middleRows(at.state, s), b.Z_lambda, b.Z_r, b.Z_z);
  p.A.middleRows(first, nc) = (-b.resistance).asDiagonal() * p.current.middleRows(at.coil, nc);
  p.position.block(at.axis, 0, na, m) = port.gap;
}

/// Readings of a bearing's axes from `axis` on; its lags take the states from `state` on, axis by
/// axis of one lag, then the next. Returns the first state behind them.
Index PlaceSensor(const LinearSensor& sensor, const LinearPort& port, Index axis, Index state,
                  LinearPlant& p) {
  const Index na = port.C.rows();
  MatrixXd in = MatrixXd::Zero(na, p.n());
  in.leftCols(p.m()) = sensor.slope.topLeftCorner(na, na) * port.C;
  for (const double lag : sensor.lags) {
    p.A.middleRows(state, na) = in / lag;
    p.A.block(state, state, na, na).diagonal().array() -= 1 / lag;
    in.setZero();
    in.middleCols(state, na).setIdentity();
    state += na;
  }
  p.reading.middleRows(axis, na) = in;
  return state;
}

/// Currents, forces, readings and what is hidden of all bearings; returns the generalised magnetic
/// forces (m x n).
MatrixXd PlaceParts(const std::vector<BearingPart>& parts, LinearPlant& p) {
  Index hidden = 0;
  for (std::size_t k = 0; k < parts.size(); ++k)
    hidden += parts[k].magnets.states() +
              static_cast<Index>(parts[k].sensor.lags.size()) * p.rotor.ports[k].C.rows();
  Resize(p, hidden);
  MatrixXd pull = MatrixXd::Zero(p.m(), p.n());
  PartPlace at{0, 0, 2 * p.m() + static_cast<Index>(p.coils.size())};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const LinearPort& port = p.rotor.ports[k];
    PlaceMagnets(parts[k].magnets, port, at, p);
    pull += port.B * p.force.middleRows(at.axis, port.C.rows());
    at.coil += parts[k].magnets.I_lambda.rows();
    at.state += parts[k].magnets.states();
    at.state = PlaceSensor(parts[k].sensor, port, at.axis, at.state, p);
    at.axis += port.C.rows();
  }
  return pull;
}

}  // namespace

LinearPlant WithDrivenRotor(LinearPlant p) {
  const Index m = p.m();
  p.A.middleRows(m, m).setZero();
  p.pushed.setZero();
  p.pushed.middleRows(m, m).setIdentity();
  return p;
}

LinearPlant LinearisePlant(const OperatingPoint& point, double speed, CurrentModel currents,
                           const std::vector<std::size_t>* axes) {
  LinearPlant p;
  p.speed = speed;
  LinearRotor whole = LinearRotorOf(point.plant(), speed);
  std::vector<LinearPort> ports;
  std::vector<BearingPart> parts;
  Index axis = 0;
  for (const std::size_t k : BearingsOf(point, axes)) {
    ports.push_back(whole.ports[k]);
    parts.push_back(PartOf(point, k, currents));
    for (PlantCoil& c : parts.back().currents) c.axis = axis;
    axis += ports.back().C.rows();
    p.coils.insert(p.coils.end(), parts.back().currents.begin(), parts.back().currents.end());
  }
  whole.ports = ports;
  p.coordinate = Moved(whole, speed);
  p.rotor = Restrict(whole, p.coordinate);
  const MatrixXd pull = PlaceParts(parts, p);
  p.measured = p.current;
  if (currents == CurrentModel::kCoils)
    for (Index j = 0; j < p.current.rows(); ++j) {
      const PlantCoil& c = p.coils[static_cast<std::size_t>(j)];
      p.measured.row(j) *= point.plant().bearings[c.bearing].current_sensor[AsSize(c.lane)].gain;
    }
  const Index m = p.m();
  const Eigen::PartialPivLU<MatrixXd> mass(p.rotor.M);
  p.A.block(0, m, m, m).setIdentity();
  p.A.middleRows(m, m) = mass.solve(pull);
  p.A.block(m, 0, m, m) -= mass.solve(p.rotor.K);
  p.A.block(m, m, m, m) -= mass.solve(p.rotor.D + speed * p.rotor.G);
  p.pushed.middleRows(m, m) = mass.solve(MatrixXd::Identity(m, m));
  return p;
}

}  // namespace ambrig
