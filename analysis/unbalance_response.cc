#include "analysis/unbalance_response.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/closed_loop_modes.h"
#include "core/math/constants.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

/// Crossing of `level` next to `peak` in direction `step`; where the curve rises above the peak or
/// the sweep ends first, that place, and `found` is false.
double HalfPower(const std::vector<double>& x, const std::vector<double>& y, std::size_t peak,
                 int step, double level, bool* found) {
  for (std::size_t k = peak;; k += static_cast<std::size_t>(step)) {
    const std::size_t next = k + static_cast<std::size_t>(step);
    *found = next < x.size() && y[next] <= level;  // beyond either end `next` is large (unsigned)
    if (*found) return std::lerp(x[k], x[next], (y[k] - level) / (y[k] - y[next]));
    if (next >= x.size() || y[next] > y[peak]) return x[k];
  }
}

}  // namespace

std::vector<ResponsePeak> FindPeaks(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<ResponsePeak> out;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    if (!(y[k] > y[k - 1] && y[k] >= y[k + 1])) continue;
    const double level = y[k] * std::numbers::sqrt2 / 2;
    bool below, above;
    const double left = HalfPower(x, y, k, -1, level, &below),
                 right = HalfPower(x, y, k, 1, level, &above);
    // The parabola through three points, unequal steps apart.
    const double a = x[k] - x[k - 1], b = x[k + 1] - x[k], fall = (y[k] - y[k - 1]) / a,
                 rise = (y[k + 1] - y[k]) / b;
    const double bend = (rise - fall) / (a + b), slope = (fall * b + rise * a) / (a + b);
    const double shift = bend < 0 ? -0.5 * slope / bend : 0;
    ResponsePeak peak;
    peak.speed = x[k] + shift;
    peak.amplitude = y[k] + 0.5 * slope * shift;
    peak.amplification = peak.speed / (right - left);
    peak.bound = !below || !above;
    out.push_back(peak);
  }
  return out;
}

std::vector<UnbalanceCase> StandardUnbalance(const OperatingPoint& point, double rated) {
  std::vector<UnbalanceCase> cases = {{"static", {}}, {"couple", {}}, {"middle", {}}};
  const double rpm = rated * 30 / kPi;
  if (rpm <= 0) return {};
  const RigParameters& rig = point.rig();
  // Static share of the mass per radial bearing, as if gravity were radial.
  std::vector<const BearingParameters*> radial;
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->two_axes) radial.push_back(&b);
  const std::vector<double> shares = RadialShares(rig);
  const double kilogram_metre = 6350.0 / rpm * 1e-6;  // per kg of load
  double total = 0;
  for (std::size_t k = 0; k < radial.size(); ++k) {
    const double load = rig.rotor.mass * std::abs(shares[k]);
    cases[0].planes.push_back({radial[k]->z, kilogram_metre * load, 0});
    cases[1].planes.push_back({radial[k]->z, kilogram_metre * load, k % 2 == 0 ? 0 : kPi});
    total += kilogram_metre * load;
  }
  cases[2].planes.push_back({0, total, 0});
  if (radial.empty()) return {};
  return cases;
}

Eigen::VectorXcd UnbalanceAt(const OperatingPoint& point, const ClosedLoop& loop,
                             const UnbalanceCase& unbalance) {
  HarmonicInput in;
  in.omega = loop.speed();
  in.pushed = Eigen::VectorXcd::Zero(loop.plant().m());
  for (const PlaneUnbalance& u : unbalance.planes) {
    // u Ω² (cos(Ωt + phase), sin(Ωt + phase)) at its plane: it turns with the shaft.
    const Complex f = u.magnitude * in.omega * in.omega * std::polar(1.0, u.phase);
    in.pushed += ShaftRows(point, loop.plant(), u.z).transpose().cast<Complex>() *
                 Eigen::Vector2cd(f, f * Complex(0, -1));
  }
  return loop.Harmonic(in);
}

std::vector<UnbalanceSweep> SweepUnbalance(const OperatingPoint& point,
                                           const std::vector<ClosedLoop>& loops,
                                           const std::vector<UnbalanceCase>& cases) {
  std::vector<UnbalanceSweep> out;
  for (const UnbalanceCase& unbalance : cases) {
    UnbalanceSweep sweep;
    sweep.unbalance = unbalance;
    std::vector<Eigen::Index> first;
    Eigen::Index axis = 0;
    for (const BearingParameters& b : point.rig().bearings) {
      if (b.kind->two_axes) {
        sweep.tracks.emplace_back();
        sweep.tracks.back().bearing = b.name;
        first.push_back(axis);
      }
      axis += static_cast<Eigen::Index>(b.Axes().size());
    }
    for (const ClosedLoop& loop : loops) {
      const Eigen::VectorXcd y = UnbalanceAt(point, loop, unbalance);
      sweep.speed.push_back(loop.speed());
      for (std::size_t k = 0; k < first.size(); ++k) {
        const Eigen::Index a = first[k];
        OrderTrack& t = sweep.tracks[k];
        t.amplitude.push_back(AxesOfOrbit(y(loop.Reading(a)), y(loop.Reading(a + 1))).major);
        t.phase.push_back(std::arg(y(loop.Reading(a))));
        t.force.push_back(AxesOfOrbit(y(loop.Force(a)), y(loop.Force(a + 1))).major);
      }
    }
    for (OrderTrack& t : sweep.tracks) t.peaks = FindPeaks(sweep.speed, t.amplitude);
    out.push_back(std::move(sweep));
  }
  return out;
}

}  // namespace ambrig
