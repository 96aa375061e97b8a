#include "discovery/model/residual_force.h"

#include <array>
#include <cmath>

#include "core/record/missing_samples.h"
#include "discovery/model/magnetic_force.h"
#include "rig/rig_channels.h"

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

namespace {

/// The two radial bearings of a rigid rotor in free motion; nullopt for anything else.
std::optional<RadialBearings> RadialPair(const RigParameters& rig, const Scenario& scenario) {
  if (scenario.start == StartState::kClamped) return std::nullopt;
  if (!rig.modes.empty()) return std::nullopt;  // two sensors do not tell how a shaft is bent
  return TwoEightPoleBearings(rig);
}

/// Readings at the two sensor planes, as motion of a rigid shaft (nominal geometry).
class MeasuredMotion {
 public:
  MeasuredMotion(const Record& d, const RadialBearings& bearings, double cutoff)
      : rate_(d.rate), cutoff_(cutoff), z_{bearings[0]->sensor.z, bearings[1]->sensor.z} {
    for (std::size_t k = 0; k < 2; ++k)
      for (const ChannelId& id : ChannelsOf(*bearings[k], ChannelKind::kReading)) {
        const Channel* c = Find(d, id);
        if (c) readings_.push_back(c->samples);
      }
  }
  bool complete() const { return readings_.size() == 4; }

  /// Centre of the shaft in plane z, side 0 x or 1 y: its derivative 0, 1 or 2 [m, m/s, m/s2].
  std::vector<double> At(double z, std::size_t side, int derivative) const {
    std::vector<double> mixed(readings_[0].size());
    const double w = (z - z_[0]) / (z_[1] - z_[0]);
    for (std::size_t k = 0; k < mixed.size(); ++k)
      mixed[k] = (1 - w) * readings_[side][k] + w * readings_[2 + side][k];
    return Smooth(mixed, rate_, cutoff_, derivative);
  }

 private:
  double rate_, cutoff_;
  std::array<double, 2> z_;
  std::vector<std::vector<double>> readings_;  // A.x, A.y, B.x, B.y
};

void FillTurning(const Record& d, const Scenario& scenario, ResidualForce& out) {
  const Channel* omega = Find(d, {ChannelKind::kSpeed});
  const Channel* theta = Find(d, {ChannelKind::kAngle});
  for (std::size_t k = 0; k < d.rows(); ++k) {
    const double t = d.TimeAt(k);
    out.t.push_back(t);
    out.omega.push_back(omega ? omega->samples[k] : scenario.speed.Speed(t));
    out.theta.push_back(theta ? theta->samples[k] : scenario.speed.Angle(t));
  }
}

/// Magnetic force of the measured currents at the measured place; false without all currents.
bool FillMagneticForce(const Record& d, const BearingParameters& b, double cutoff,
                       ResidualForce::Plane& plane) {
  const auto force = MagneticForce(d, b, plane.x, plane.y);
  if (!force) return false;
  plane.magnetic_x = Smooth(force->x, d.rate, cutoff);
  plane.magnetic_y = Smooth(force->y, d.rate, cutoff);
  return true;
}

/// Force [N] and moment [N m] about the centre of mass.
struct Wrench {
  double Fx = 0, Fy = 0, Mx = 0, My = 0;
};

/// A motion of the shaft in one direction: of its centre of mass, and its slope along z.
struct CentreAndSlope {
  double centre = 0, slope = 0;
};

/// What a rigid rotor needs for its motion less weight and loads: F = m a,
/// M = It a'' + gyroscopic part. `ax`, `ay`: accelerations; the rates are those of the slopes.
Wrench NeededWrench(const RigParameters& rig, const Scenario& scenario, double t, double omega,
                    const CentreAndSlope& ax, const CentreAndSlope& ay, double x_slope_rate,
                    double y_slope_rate) {
  const double It = rig.rotor.inertia_transverse, Ip = rig.rotor.inertia_polar;
  // x + z beta, y - z alpha: slopes are beta and -alpha.
  const double beta_dd = ax.slope, alpha_dd = -ay.slope;
  const double beta_d = x_slope_rate, alpha_d = -y_slope_rate;
  Wrench w;
  w.Fx = rig.rotor.mass * (ax.centre - rig.gravity[0]);
  w.Fy = rig.rotor.mass * (ay.centre - rig.gravity[1]);
  w.My = It * beta_dd - Ip * omega * alpha_d;
  w.Mx = It * alpha_dd + Ip * omega * beta_d;
  for (const LoadSpec& l : scenario.loads)
    if (t >= l.start && t < l.stop) {
      w.Fx -= l.fx;
      w.Fy -= l.fy;
      w.My -= l.z * l.fx;
      w.Mx += l.z * l.fy;
    }
  return w;
}

/// The wrench that the motion needs, as forces in the two planes, less the magnetic forces there.
void FillMissingForce(const RigParameters& rig, const Scenario& scenario,
                      const MeasuredMotion& motion, const RadialBearings& bearings,
                      ResidualForce& out) {
  const double zA = bearings[0]->z, zB = bearings[1]->z;
  const std::vector<double> axA = motion.At(zA, 0, 2), ayA = motion.At(zA, 1, 2),
                            axB = motion.At(zB, 0, 2), ayB = motion.At(zB, 1, 2);
  const auto slope = [&](double at_a, double at_b) { return (at_b - at_a) / (zB - zA); };
  const auto centre = [&](double at_a, double at_b) {
    const double s = slope(at_a, at_b);
    return CentreAndSlope{at_a - s * zA, s};
  };
  ResidualForce::Plane &A = out.planes[0], &B = out.planes[1];
  for (std::size_t k = 0; k < out.t.size(); ++k) {
    const Wrench w =
        NeededWrench(rig, scenario, out.t[k], out.omega[k], centre(axA[k], axB[k]),
                     centre(ayA[k], ayB[k]), slope(A.vx[k], B.vx[k]), slope(A.vy[k], B.vy[k]));
    const double fxB = (w.My - zA * w.Fx) / (zB - zA), fyB = (-w.Mx - zA * w.Fy) / (zB - zA);
    A.fx.push_back(w.Fx - fxB - A.magnetic_x[k]);
    A.fy.push_back(w.Fy - fyB - A.magnetic_y[k]);
    B.fx.push_back(fxB - B.magnetic_x[k]);
    B.fy.push_back(fyB - B.magnetic_y[k]);
  }
}

}  // namespace

std::optional<ResidualForce> EstimateResidualForce(const RigParameters& rig,
                                                   const Scenario& scenario, const Record& data,
                                                   double cutoff) {
  const auto bearings = RadialPair(rig, scenario);
  if (!bearings) return std::nullopt;
  // one NaN would be smoothed into all its neighbours
  const Record d = BridgeMissing(data, 0, [](const std::string&) { return true; }).record;
  const MeasuredMotion motion(d, *bearings, cutoff);
  if (!motion.complete()) return std::nullopt;
  ResidualForce out;
  FillTurning(d, scenario, out);
  for (const BearingParameters* b : *bearings) {
    ResidualForce::Plane plane;
    plane.bearing = b->name;
    plane.x = motion.At(b->z, 0, 0);
    plane.y = motion.At(b->z, 1, 0);
    plane.vx = motion.At(b->z, 0, 1);
    plane.vy = motion.At(b->z, 1, 1);
    if (!FillMagneticForce(d, *b, cutoff, plane)) return std::nullopt;
    out.planes.push_back(std::move(plane));
  }
  FillMissingForce(rig, scenario, motion, *bearings, out);
  return out;
}

}  // namespace ambrig
