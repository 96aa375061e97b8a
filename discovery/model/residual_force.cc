#include "discovery/model/residual_force.h"

#include <fmt/format.h>

#include <cmath>

#include "actuators/magnetics/radial_stator.h"
#include "core/record/missing_samples.h"

namespace ambrig {

std::vector<double> Smooth(const std::vector<double>& y, double rate, double cutoff,
                           int derivative) {
  // [rows], |H| = 0.707 at cutoff
  const double sigma = std::sqrt(std::log(2.0)) / (2 * kPi * cutoff) * rate;
  const int half = static_cast<int>(std::ceil(5 * sigma));
  std::vector<double> kernel(static_cast<std::size_t>(2 * half + 1));
  double sum = 0;
  for (int k = -half; k <= half; ++k) sum += std::exp(-0.5 * k * k / sigma / sigma);
  for (int k = -half; k <= half; ++k) {
    const double g = std::exp(-0.5 * k * k / sigma / sigma) / sum, u = k / sigma;
    // y(t) = Σ g(k) y(t + k): derivatives of the kernel with respect to t carry the sign of k.
    kernel[static_cast<std::size_t>(k + half)] =
        derivative == 0   ? g
        : derivative == 1 ? g * u / sigma * rate
                          : g * (u * u - 1) / sigma / sigma * rate * rate;
  }
  const int n = static_cast<int>(y.size());
  std::vector<double> out(y.size(), 0.0);
  for (int k = 0; k < n; ++k)
    for (int m = -half; m <= half; ++m) {
      const int at = std::min(n - 1, std::max(0, k + m));
      out[static_cast<std::size_t>(k)] +=
          kernel[static_cast<std::size_t>(m + half)] * y[static_cast<std::size_t>(at)];
    }
  return out;
}

std::optional<ResidualForce> EstimateResidualForce(const RigParameters& rig,
                                                   const Scenario& scenario, const Record& data,
                                                   double cutoff) {
  if (scenario.start == StartState::kClamped) return std::nullopt;
  if (!rig.modes.empty()) return std::nullopt;  // two sensors do not tell how a shaft is bent
  std::vector<const BearingParameters*> bearings;
  for (const auto& b : rig.bearings)
    if (b.kind == BearingKind::kRadial) bearings.push_back(&b);
  if (bearings.size() != 2) return std::nullopt;
  // one NaN would be smoothed into all its neighbours
  const Record d = BridgeMissing(data, 0, [](const std::string&) { return true; }).record;
  const std::size_t n = d.rows();
  ResidualForce out;
  // Readings at the sensor planes -> shaft centre at the bearing planes (rigid, nominal geometry).
  std::vector<double> sensor[4];
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t side = 0; side < 2; ++side) {
      const Channel* c = d.Find(bearings[k]->name + (side == 0 ? ".x" : ".y"));
      if (!c) return std::nullopt;
      sensor[2 * k + side] = c->samples;
    }
  const double zs0 = bearings[0]->sensor.z, zs1 = bearings[1]->sensor.z;
  const auto at_plane = [&](double z, std::size_t side, int derivative) {
    std::vector<double> mixed(n);
    const double w = (z - zs0) / (zs1 - zs0);
    for (std::size_t k = 0; k < n; ++k)
      mixed[k] = (1 - w) * sensor[side][k] + w * sensor[2 + side][k];
    return Smooth(mixed, d.rate, cutoff, derivative);
  };
  const Channel* omega = d.Find("omega");
  const Channel* theta = d.Find("theta");
  for (std::size_t k = 0; k < n; ++k) {
    const double t = d.TimeAt(k);
    out.t.push_back(t);
    out.omega.push_back(omega ? omega->samples[k] : scenario.speed.Speed(t));
    out.theta.push_back(theta ? theta->samples[k] : scenario.speed.Angle(t));
  }
  for (const BearingParameters* b : bearings) {
    ResidualForce::Plane plane;
    plane.bearing = b->name;
    plane.x = at_plane(b->z, 0, 0);
    plane.y = at_plane(b->z, 1, 0);
    plane.vx = at_plane(b->z, 0, 1);
    plane.vy = at_plane(b->z, 1, 1);
    const RadialStator stator(b->radial);
    std::vector<double> fx(n), fy(n);
    const Channel* current[kPoles];
    for (int j = 0; j < kPoles; ++j) {
      current[j] = d.Find(fmt::format("{}.i{}", b->name, j + 1));
      if (!current[j]) return std::nullopt;
    }
    for (std::size_t k = 0; k < n; ++k) {
      CoilVector i;
      for (int j = 0; j < kPoles; ++j) i[j] = current[j]->samples[k];
      const Eigen::Vector2d f = stator.Force({plane.x[k], plane.y[k]}, i);
      fx[k] = f.x();
      fy[k] = f.y();
    }
    plane.magnetic_x = Smooth(fx, d.rate, cutoff);
    plane.magnetic_y = Smooth(fy, d.rate, cutoff);
    out.planes.push_back(std::move(plane));
  }
  // Rigid motion needs F = m a and M = It a'' + gyroscopic part; solved for the two plane forces.
  const double zA = bearings[0]->z, zB = bearings[1]->z, m = rig.rotor.mass,
               It = rig.rotor.inertia_transverse, Ip = rig.rotor.inertia_polar;
  std::vector<double> a[4], v[4];
  for (std::size_t side = 0; side < 2; ++side) {
    a[side] = at_plane(zA, side, 2);
    a[2 + side] = at_plane(zB, side, 2);
    v[side] = out.planes[0].vx;
    v[2 + side] = out.planes[1].vx;
  }
  for (auto& p : out.planes) {
    p.fx.resize(n);
    p.fy.resize(n);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto motion = [&](double at_a, double at_b, double* centre, double* slope) {
      *slope = (at_b - at_a) / (zB - zA);
      *centre = at_a - *slope * zA;
    };
    double ax, sax, ay, say, vx, svx, vy, svy;
    motion(a[0][k], a[2][k], &ax, &sax);
    motion(a[1][k], a[3][k], &ay, &say);
    motion(out.planes[0].vx[k], out.planes[1].vx[k], &vx, &svx);
    motion(out.planes[0].vy[k], out.planes[1].vy[k], &vy, &svy);
    // x + z beta, y - z alpha: slopes are beta and -alpha.
    const double beta_dd = sax, alpha_dd = -say, beta_d = svx, alpha_d = -svy;
    double Fx = m * (ax - rig.gravity[0]), Fy = m * (ay - rig.gravity[1]);
    double My = It * beta_dd - Ip * out.omega[k] * alpha_d,
           Mx = It * alpha_dd + Ip * out.omega[k] * beta_d;
    for (const LoadSpec& l : scenario.loads)
      if (out.t[k] >= l.start && out.t[k] < l.stop) {
        Fx -= l.fx;
        Fy -= l.fy;
        My -= l.z * l.fx;
        Mx += l.z * l.fy;
      }
    const double fxB = (My - zA * Fx) / (zB - zA), fyB = (-Mx - zA * Fy) / (zB - zA);
    out.planes[0].fx[k] = Fx - fxB - out.planes[0].magnetic_x[k];
    out.planes[0].fy[k] = Fy - fyB - out.planes[0].magnetic_y[k];
    out.planes[1].fx[k] = fxB - out.planes[1].magnetic_x[k];
    out.planes[1].fy[k] = fyB - out.planes[1].magnetic_y[k];
  }
  return out;
}

}  // namespace ambrig
