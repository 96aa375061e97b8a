#include "analysis/load_capacity.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "actuators/magnetics/coil_network.h"
#include "analysis/linear/bridge_point.h"
#include "core/math/constants.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

/// Least voltage step left to a coil, up or down, as a mean over a period [V].
double VoltageLeft(const AmplifierParameters& p, double bus, double duty) {
  const auto mean = [&](double d) { return BridgeAt(p, {}, bus, d).volts; };
  return std::min(mean(p.duty_max) - mean(duty), mean(duty) - mean(p.duty_min));
}

/// Largest v along +side until a set-point meets a limit [A].
double LinearLimit(const BearingControl& c, Eigen::Index side) {
  const double low = c.map.unipolar ? 0 : -c.map.i_max;
  double least = kInfinity;
  for (int j = 0; j < c.coils; ++j) {
    const double bias = c.map.W(j, 0) * c.map.c0, w = c.map.W(j, 1 + side);
    if (w != 0)
      least =
          std::min(least, std::min((c.map.i_max - bias) / std::abs(w), (bias - low) / std::abs(w)));
  }
  return least;
}

/// Largest exact force along +side over growing commands, set-points clamped [N].
double LargestForce(const BearingControl& c, const StatorLanes& lanes, Eigen::Index side,
                    double bound) {
  std::optional<CoilNetwork> network;
  if (!lanes.network) network.emplace(lanes);
  double best = 0;
  constexpr int kSteps = 400;
  for (int k = 0; k <= kSteps; ++k) {
    const double f = bound * k / kSteps;
    const auto set = c.map.SetPoints(side == 0 ? f : 0, side == 1 ? f : 0);
    if (!network) {
      const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      best = std::max(best, lanes.network->Force(centre, lanes.CountedCurrents(set.data()))[side]);
      continue;
    }
    double lambda[kMaxWindings] = {};
    NetworkState s;
    network->Linkages(set.data(), 0, 0, lambda);
    network->Solve(lambda, 0, 0, s);
    best = std::max(best, side == 0 ? s.fx : s.fy);
  }
  return best;
}

}  // namespace

double AxisCapacity::usable() const { return std::min(linear, commanded); }

std::vector<AxisCapacity> FindCapacity(const OperatingPoint& point) {
  std::vector<AxisCapacity> out;
  const auto names = point.Axes();
  for (std::size_t bearing = 0; bearing < point.bearings.size(); ++bearing) {
    const BearingControl& control = point.control()[bearing];
    const LinearBearing& linear = point.bearings[bearing];
    const std::size_t first = point.FirstAxis(bearing);
    const Eigen::MatrixXd ki = linear.ForceOfCurrent(), L = linear.Inductance();
    for (std::size_t side = 0; side < point.AxisCount(bearing); ++side) {
      const auto k = static_cast<Eigen::Index>(side);
      Eigen::VectorXd w(static_cast<Eigen::Index>(linear.coils.size()));
      for (Eigen::Index j = 0; j < w.size(); ++j)
        w(j) = control.map.W(linear.coils[static_cast<std::size_t>(j)], 1 + k);
      AxisCapacity c;
      c.axis = names[first + side];
      c.k_i = ki.row(k) * w;
      c.k_s = linear.NegativeStiffness()(k, k);
      const double scale = control.map.k * control.map.c0;
      c.linear = scale * LinearLimit(control, k);
      c.commanded = PidOf(point.rig(), point.rig().bearings[bearing]).f_max;
      c.largest = LargestForce(control, point.plant().bearings[bearing].lanes, k,
                               scale * 4 * control.map.i_max);
      c.weight = point.force[first + side];
      if (std::abs(c.weight) < 1e-9 * scale) c.weight = 0;  // rounding of the equilibrium
      const Eigen::VectorXd volts = L * w;
      c.slew = kInfinity;
      for (Eigen::Index j = 0; j < w.size(); ++j) {
        const CoilPoint& at =
            point.coils[bearing]
                       [static_cast<std::size_t>(linear.coils[static_cast<std::size_t>(j)])];
        if (volts(j) == 0) continue;
        const double left = VoltageLeft(point.rig().amplifier, point.plant().bus.voltage, at.duty);
        c.slew = std::min(c.slew, scale * left / std::abs(volts(j)));
      }
      c.knee = c.slew / (2 * kPi * c.usable());
      out.push_back(c);
    }
  }
  return out;
}

}  // namespace ambrig
