#include "rig/magnet_inverse.h"

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/stator_parameters.h"
#include "rig/nominal_control.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

constexpr int kRounds = 12;
constexpr double kClosest = 0.9;  // of the gap: readings beyond are those of a rotor that touches
constexpr double kLeastSquareGain = 1e-12;  // of (dF/di)²: nothing to invert
constexpr double kExact = 1e-12;            // of the force [N] asked for, beside 1 N

/// Force over currents and place, and its derivatives.
struct MagnetLaw {
  int axes = 2;
  double gap = 0;  // [m]
  MagnetForce force;
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&i, const Eigen::Vector2d&r)> of_current,
      of_place;
};

MagnetLaw LawOf(std::shared_ptr<const PoleNetwork> n, int axes) {
  const auto at = [](const Eigen::Vector2d& r) { return Eigen::Vector3d(r.x(), r.y(), 0); };
  return {axes, n->SmallestGap(),
          [n, axes, at](const auto& i, const auto& r) -> Eigen::VectorXd {
            return n->Force(at(r), i).head(axes);
          },
          [n, axes, at](const auto& i, const auto& r) -> Eigen::MatrixXd {
            return n->ForceOfCurrent(at(r), i).topRows(axes);
          },
          [n, axes, at](const auto& i, const auto& r) -> Eigen::MatrixXd {
            return n->NegativeStiffness(at(r), i).topLeftCorner(axes, axes);
          }};
}

/// f = i1² L0 gc/(2 (gc + g - x)²) - the same of coil 2.
MagnetLaw LawOf(const OpposedStatorParameters& p) {
  const auto pull = [p](int coil, double x, int power) {
    const double reach = p.gap_constant + p.gap - (coil == 0 ? x : -x);
    return (coil == 0 ? 1 : -1) * p.inductance_near * p.gap_constant / std::pow(reach, power);
  };
  return {1, p.gap,
          [pull](const auto& i, const auto& r) -> Eigen::VectorXd {
            double f = 0;
            for (int j = 0; j < i.size(); ++j) f += 0.5 * i[j] * i[j] * pull(j, r.x(), 2);
            return Eigen::VectorXd::Constant(1, f);
          },
          [pull](const auto& i, const auto& r) -> Eigen::MatrixXd {
            Eigen::MatrixXd J(1, i.size());
            for (int j = 0; j < i.size(); ++j) J(0, j) = i[j] * pull(j, r.x(), 2);
            return J;
          },
          [pull](const auto& i, const auto& r) -> Eigen::MatrixXd {
            double k = 0;
            for (int j = 0; j < i.size(); ++j) k += i[j] * i[j] * std::abs(pull(j, r.x(), 3));
            return Eigen::MatrixXd::Constant(1, 1, k);
          }};
}

/// The classic kinds as the networks that they are
/// (tests/actuators/magnetics/pole_network_test.cc).
std::shared_ptr<const PoleNetwork> NetworkOfClassic(const BearingParameters& b) {
  StatorParameters p;
  p.leakage_inductance = p.resistance = 1;  // no force of theirs
  if (b.kind->axial) {
    p.pattern = "axial";
    p.connection = "two-a-side";
    p.axial = true;
    p.turns = b.thrust.turns;
    p.pole_area = b.thrust.pole_area;
    p.gap = b.thrust.gap;
  } else {
    p.pattern = "one-coil-per-pole";
    p.pole_count = kPoles;
    p.winding = b.radial.winding;
    p.first_pole_angle_deg = b.radial.first_pole_angle_deg;
    p.turns = b.radial.turns;
    p.pole_area = b.radial.pole_area;
    p.gap = b.radial.gap;
  }
  return NetworkOf(p);
}

MagnetLaw LawOf(const BearingParameters& b) {
  if (const auto network = b.kind->stator(b).network)
    return LawOf(network, b.kind->two_axes ? 2 : 1);
  if (b.kind->two_axes || b.kind->axial)
    return LawOf(NetworkOfClassic(b), b.kind->two_axes ? 2 : 1);
  return LawOf(b.opposed);
}

Lane Inverted(const MagnetLaw& law, const CurrentMap& map, int coils, const Eigen::Vector2d& f,
              const Eigen::Vector2d& r) {
  Eigen::Vector2d at = r;
  if (const double most = kClosest * law.gap; at.norm() > most) at *= most / at.norm();
  const double lo = map.unipolar ? 0 : -map.i_max;
  Eigen::VectorXd i = map.SetPoints(f.x(), f.y()).head(coils);
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd open = f.head(law.axes) - law.force(i, at);
    if (open.norm() < kExact * (1 + f.norm())) break;
    const Eigen::MatrixXd J = law.of_current(i, at);
    const Eigen::MatrixXd gain = J * J.transpose();
    if (!(gain.determinant() > kLeastSquareGain)) break;
    i += J.transpose() * gain.ldlt().solve(open);
    i = i.cwiseMax(lo).cwiseMin(map.i_max);
  }
  Lane out;
  for (int j = 0; j < coils; ++j) out[j] = i[j];
  return out;
}

}  // namespace

MagnetForce MagnetForceOf(const BearingParameters& b) { return LawOf(b).force; }

MagnetInverse MagnetInverseOf(const NominalRig& rig, std::size_t bearing,
                              const Eigen::Vector2d& weight) {
  const BearingParameters& b = rig->bearings[bearing];
  const MagnetLaw law = LawOf(b);
  const CurrentMap map = MakeBearingControl(rig, bearing).map;
  const int coils = b.coils();
  MagnetInverse out;
  out.currents = [law, map, coils](const Eigen::Vector2d& f, const Eigen::Vector2d& r) {
    return Inverted(law, map, coils, f, r);
  };
  const Eigen::VectorXd carried = map.SetPoints(weight.x(), weight.y()).head(coils);
  out.negative_stiffness.setZero();
  out.negative_stiffness.topLeftCorner(law.axes, law.axes) =
      law.of_place(carried, Eigen::Vector2d::Zero());
  return out;
}

}  // namespace ambrig
