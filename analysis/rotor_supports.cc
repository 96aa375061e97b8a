#include "analysis/rotor_supports.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/closed_loop_modes.h"
#include "core/math/constants.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The plant's rotor without its axial coordinate.
struct RadialRotor {
  LinearRotor rotor;
  std::vector<int> coordinate;  // in MotionState::q
};

RadialRotor WithoutAxial(const LinearPlant& plant) {
  std::vector<int> kept;
  RadialRotor out;
  for (int k = 0; k < static_cast<int>(plant.m()); ++k)
    if (plant.coordinate[static_cast<std::size_t>(k)] != 2) {
      kept.push_back(k);
      out.coordinate.push_back(plant.coordinate[static_cast<std::size_t>(k)]);
    }
  const LinearRotor& r = plant.rotor;
  out.rotor.M = r.M(kept, kept);
  out.rotor.G = r.G(kept, kept);
  out.rotor.D = r.D(kept, kept);
  out.rotor.K = r.K(kept, kept);
  for (const auto& [x, y] : r.xy) {
    const auto at = [&](int k) {
      return static_cast<int>(std::find(kept.begin(), kept.end(), k) - kept.begin());
    };
    out.rotor.xy.push_back({at(x), at(y)});
  }
  for (LinearPort p : r.ports) {
    p.B = MatrixXd(p.B(kept, Eigen::all));
    p.gap = MatrixXd(p.gap(Eigen::all, kept));
    out.rotor.ports.push_back(p);
  }
  return out;
}

/// Undamped modes at rest, planar pairs once.
std::vector<RotorMode> ModesAtRest(const OperatingPoint& point, const LinearPlant& plant,
                                   const RadialRotor& r, const MatrixXd& K, int count) {
  const MatrixXd symmetric = 0.5 * (K + K.transpose());
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(symmetric, r.rotor.M);
  std::vector<RotorMode> out;
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  for (Index k = 0; k < K.rows() && static_cast<int>(out.size()) < count; ++k) {
    const double w2 = eigen.eigenvalues()(k);
    if (w2 < 1e-9 * largest || w2 < 1e-3) continue;  // rigid modes of a free rotor
    RotorMode mode;
    mode.frequency = std::sqrt(w2) / (2 * kPi);
    // the other plane
    if (!out.empty() && mode.frequency < out.back().frequency * (1 + 1e-6)) continue;
    for (double z : ShaftStations(point)) {
      const MatrixXd all = PlaneRows(point.plant().rotor, point.plant().rotor.MakePlane(z));
      const Eigen::Vector2d d = all(Eigen::all, r.coordinate) * eigen.eigenvectors().col(k);
      mode.z.push_back(z);
      mode.x.push_back(d.x() + d.y());  // one of them is zero, or both planes move alike
    }
    double peak = 0;
    for (double x : mode.x)
      if (std::abs(x) > std::abs(peak)) peak = x;
    if (peak != 0)
      for (double& x : mode.x) x /= peak;
    out.push_back(std::move(mode));
  }
  (void)plant;
  return out;
}

MatrixXd Supported(const RadialRotor& r, const std::vector<double>& k) {
  MatrixXd K = r.rotor.K;
  for (std::size_t p = 0; p < r.rotor.ports.size(); ++p)
    if (k[p] != 0) K += k[p] * r.rotor.ports[p].B * r.rotor.ports[p].gap;
  return K;
}

std::vector<CriticalSpeed> Criticals(RadialRotor r, const MatrixXd& K, int count) {
  r.rotor.K = K;
  if (Eigen::LLT<MatrixXd>(0.5 * (K + K.transpose())).info() != Eigen::Success) return {};
  if ((K - K.transpose()).cwiseAbs().maxCoeff() > 1e-9 * K.cwiseAbs().maxCoeff()) return {};
  return CriticalSpeeds(r.rotor, count);
}

}  // namespace

RotorOnSupports AnalyseSupports(const OperatingPoint& point, int modes) {
  RotorOnSupports out;
  const LinearPlant plant = LinearisePlant(point, 0);
  const RadialRotor r = WithoutAxial(plant);
  std::vector<double> net;
  double weight = 0;
  for (std::size_t k = 0; k < point.bearings.size(); ++k) {
    const BearingParameters& b = point.rig().bearings[k];
    const Eigen::Matrix2d ks = point.bearings[k].NegativeStiffness();
    SupportStiffness s{b.name, PidOf(point.rig(), b).kp,
                       b.kind->two_axes ? 0.5 * ks.trace() : ks(0, 0)};
    net.push_back(b.kind->axial ? 0.0 : s.net());
    if (b.kind->axial) continue;
    weight = std::max(weight, std::abs(s.proportional));
    out.supports.push_back(s);
  }
  out.free = ModesAtRest(point, plant, r, r.rotor.K, modes);
  const MatrixXd K = Supported(r, net);
  out.supported = ModesAtRest(point, plant, r, K, modes);
  out.critical = Criticals(r, K, 2 * modes);
  constexpr int kRows = 49;  // four decades around the controller's gain
  for (int k = 0; k < kRows && weight > 0; ++k) {
    const double stiffness = weight * std::pow(10.0, -2 + 4 * k / (kRows - 1.0));
    std::vector<double> common;
    for (double n : net) common.push_back(n == 0 ? 0.0 : stiffness);
    CriticalMapRow row{stiffness, Criticals(r, Supported(r, common), 2 * modes)};
    out.map.push_back(std::move(row));
  }
  return out;
}

}  // namespace ambrig
