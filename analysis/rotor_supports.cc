#include "analysis/rotor_supports.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/closed_loop_modes.h"
#include "core/math/constants.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/parameters/rig_rotor.h"
#include "rig/rig_assembly.h"
#include "rotor/motion/linearise.h"
#include "rotor/shaft/reduction.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The plant's rotor without its axial coordinate.
struct RadialRotor {
  LinearRotor rotor;
  std::vector<int> coordinate;  // in MotionState::q
  std::vector<double> z;        // stations
  std::vector<MatrixXd> rows;   // (x, y) there (2 x dofs)
};

RadialRotor WithoutAxial(const OperatingPoint& point, const LinearPlant& plant) {
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
  for (double z : ShaftStations(point)) {
    const RotorModel& model = point.plant().rotor;
    out.z.push_back(z);
    out.rows.emplace_back(PlaneRows(model, model.MakePlane(z))(Eigen::all, out.coordinate));
  }
  return out;
}

/// Where a coordinate of MotionState::q stands in a reduced rotor of `modes`; -1: not of the shaft.
int InReduced(int coordinate, int kept, int modes) {
  if (coordinate < 2) return coordinate;
  if (coordinate < 5) return coordinate - 1;
  const int k = (coordinate - 5) / 2;
  return k < kept ? 4 + k + (coordinate % 2 ? 0 : modes) : -1;
}

/// The same with all bending modes of a beam that its elements carry, not only those that runs
/// keep: what effects add to the kept coordinates stays. Of a rotor on a base or on mounts nothing
/// changes.
RadialRotor WithWholeBeam(const RigParameters& rig, RadialRotor kept) {
  if (!rig.beam) return kept;
  constexpr int kMost = 60;
  const BeamFile& file = *rig.beam;
  const BeamRotor beam = BuildBeam(file.definition);
  const int modes = std::min<int>(kMost, static_cast<int>(beam.M.rows()) - 2),
            few = static_cast<int>(rig.modes.size()), bending = std::min(few, file.modes);
  std::vector<int> at;
  // A residual mode is none of the whole beam's: what an effect adds to it has no place there.
  constexpr int kNoPlace = -2;
  for (int c : kept.coordinate)
    at.push_back(c >= 5 + 2 * bending && c < 5 + 2 * few ? kNoPlace : InReduced(c, few, modes));
  // On a base or on mounts, or where no bearing moves one of the shaft's own coordinates.
  if (std::find(at.begin(), at.end(), -1) != at.end() ||
      kept.coordinate.size() != static_cast<std::size_t>(4 + 2 * few))
    return kept;
  const ReducedRotor all = Reduce(beam, modes, {0.0}),
                     part = Reduce(beam, bending, {0.0}, ResidualPlanes(rig));
  RadialRotor out;
  out.rotor = Linear(all);
  LinearRotor own = Linear(part);  // what of the kept stiffness is the shaft's and its supports'
  for (const SpringSupport& s : file.definition.supports) {
    SpringSupport at_rest = IsotropicSupport(s.z, 0, 0);
    static_cast<SupportCoefficients&>(at_rest) = s.At(0);
    AddSupport(all, at_rest, out.rotor);
    AddSupport(part, at_rest, own);
  }
  std::vector<int> in_part;
  for (int c : kept.coordinate) in_part.push_back(InReduced(c, few, few));
  const MatrixXd more = kept.rotor.K - own.K(in_part, in_part);
  const double noise = 1e-8 * kept.rotor.K.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < at.size(); ++j) {
      if (at[i] < 0 || at[j] < 0) continue;
      const double v = more(static_cast<Index>(i), static_cast<Index>(j));
      if (std::abs(v) > noise) out.rotor.K(at[i], at[j]) += v;
    }
  const auto rows = [&](double z) { return StationRows(StationAt(all, z + rig.z_origin)); };
  for (LinearPort p : kept.rotor.ports) {
    // Every port pushes and reads x and y of its plane.
    const MatrixXd push = p.B.topRows(2), read = p.gap.leftCols(2), plane = rows(p.z);
    p.B = plane.transpose() * push;
    p.gap = read * plane;
    out.rotor.ports.push_back(p);
  }
  out.z = kept.z;
  for (double z : kept.z) out.rows.push_back(rows(z));
  return out;
}

/// Undamped modes at rest, planar pairs once.
std::vector<RotorMode> ModesAtRest(const RadialRotor& r, const MatrixXd& K, int count) {
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
    for (std::size_t i = 0; i < r.z.size(); ++i) {
      const Eigen::Vector2d d = r.rows[i] * eigen.eigenvectors().col(k);
      mode.z.push_back(r.z[i]);
      mode.x.push_back(d.x() + d.y());  // one of them is zero, or both planes move alike
    }
    double peak = 0;
    for (double x : mode.x)
      if (std::abs(x) > std::abs(peak)) peak = x;
    if (peak != 0)
      for (double& x : mode.x) x /= peak;
    out.push_back(std::move(mode));
  }
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
  if (Eigen::LLT<MatrixXd>(MatrixXd(0.5 * (K + K.transpose()))).info() != Eigen::Success) return {};
  if ((K - K.transpose()).cwiseAbs().maxCoeff() > 1e-9 * K.cwiseAbs().maxCoeff()) return {};
  return CriticalSpeeds(r.rotor, count);
}

}  // namespace

RotorOnSupports AnalyseSupports(const OperatingPoint& point, int modes) {
  RotorOnSupports out;
  const LinearPlant plant = LinearisePlant(point, 0);
  const RadialRotor r = WithWholeBeam(point.rig(), WithoutAxial(point, plant));
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
  out.free = ModesAtRest(r, r.rotor.K, modes);
  const MatrixXd K = Supported(r, net);
  out.supported = ModesAtRest(r, K, modes);
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
