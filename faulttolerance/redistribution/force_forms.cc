#include "faulttolerance/redistribution/force_forms.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "actuators/magnetics/stator_geometry.h"
#include "core/base/errors.h"
#include "core/math/constants.h"

namespace ambrig {
namespace {

/// One limited quantity: size of its bias part and of its control part.
struct Amplitude {
  double bias, control;
};

double CapacityAt(double t, const std::vector<Amplitude>& rows) {
  double peak = 0;
  for (const Amplitude& r : rows) peak = std::max(peak, r.bias + t * r.control);
  return peak > 0 ? 4 * t / (peak * peak) : 0;
}

/// Each row's bound 4t/(b + tw)^2 has one maximum, at t = b/w, and the smallest of them is
/// searched: the maximum lies at one row's own, where two rows cross, or at the end of the range.
double BestCapacity(const std::vector<Amplitude>& rows, double t_max) {
  std::vector<double> candidates;
  if (std::isfinite(t_max)) candidates.push_back(t_max);
  for (const Amplitude& p : rows) {
    if (p.control > 0) candidates.push_back(p.bias / p.control);
    for (const Amplitude& q : rows) {
      const double t = (q.bias - p.bias) / (p.control - q.control);
      if (std::isfinite(t)) candidates.push_back(t);
    }
  }
  double best = 0;
  for (double t : candidates)
    if (t > 0 && t <= t_max) best = std::max(best, CapacityAt(t, rows));
  return best;
}

double ControlSize(const DistributionMatrix& W, int j) { return std::hypot(W(j, 1), W(j, 2)); }

}  // namespace

RedistributionProblem RedistributionProblemOf(const RadialStatorParameters& stator) {
  const StatorGeometry geometry = GeometryOf(stator);
  const std::vector<double> angles = geometry.Angles();
  RedistributionProblem p;
  for (int j = 0; j < kPoles; ++j) {
    p.angle[j] = angles[static_cast<std::size_t>(j)];
    p.sign[j] = geometry.n[j] < 0 ? -1 : 1;
  }
  p.turns = stator.turns;
  p.pole_area = stator.pole_area;
  p.gap = stator.gap;
  return p;
}

double ForceFactor(const RedistributionProblem& p) {
  return 4 * kMu0 * p.turns * p.turns * p.pole_area / (p.gap * p.gap);
}

ForceForms MakeForceForms(const RedistributionProblem& p) {
  ForceForms forms;
  const CoilVector c = p.angle.array().cos(), s = p.angle.array().sin();
  forms.flux = (CoilForm::Identity() - CoilForm::Constant(1.0 / 8)) *
               p.sign.cwiseProduct(p.turns_left).asDiagonal();
  const auto through_flux = [&](const CoilForm& form) -> CoilForm {
    return forms.flux.transpose() * form * forms.flux / 4;
  };
  const auto stiffness = [&](const CoilVector& u, const CoilVector& v) {
    return through_flux(CoilForm(u.cwiseProduct(v).asDiagonal()) - u * v.transpose() / 8);
  };
  forms.Q = {through_flux(c.asDiagonal()), through_flux(s.asDiagonal())};
  forms.R = {stiffness(c, c), stiffness(c, s), stiffness(s, s)};
  forms.R[1] = CoilForm((forms.R[1] + forms.R[1].transpose()) / 2);
  return forms;
}

Eigen::Vector<double, 12> EquationErrors(const ForceForms& forms, const DistributionMatrix& W) {
  Eigen::Vector<double, 12> errors;
  int row = 0;
  for (const auto& [p, q] : {std::pair{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}})
    for (int axis = 0; axis < 2; ++axis)
      errors[row++] = W.col(p).dot(forms.Q[axis] * W.col(q)) - (p == 0 && q == axis + 1);
  return errors;
}

DistributionMatrix HealthyDistribution(const RedistributionProblem& p) {
  DistributionMatrix W;
  W << CoilVector::Ones(), p.angle.array().cos().matrix(), p.angle.array().sin().matrix();
  return W;
}

Eigen::Matrix2d NegativeStiffness(const RedistributionProblem& p, const ForceForms& forms,
                                  const DistributionMatrix& W) {
  const CoilVector b = W.col(0);
  Eigen::Vector3d kappa;
  for (int e = 0; e < 3; ++e) kappa[e] = b.dot(forms.R[e] * b);
  Eigen::Matrix2d K;
  K << kappa[0], kappa[1], kappa[1], kappa[2];
  return ForceFactor(p) * p.c0 * p.c0 / p.gap * K;
}

double LargestEigenvalue(const Eigen::Matrix2d& K) {
  return (K(0, 0) + K(1, 1)) / 2 + std::hypot((K(0, 0) - K(1, 1)) / 2, K(0, 1));
}

double UnipolarDisc(const RedistributionProblem& p, const DistributionMatrix& W) {
  double rho = std::numeric_limits<double>::infinity();
  if (p.quadrants == 4) return rho;
  for (int j = 0; j < 8; ++j) {
    const double w = ControlSize(W, j);
    if (W(j, 0) < 0) return 0;
    if (w > 0) rho = std::min(rho, W(j, 0) / w);
  }
  return rho;
}

double WorkingDisc(const RedistributionProblem& p, const DistributionMatrix& W) {
  if (W.rightCols(2).isZero()) return 0;  // no force at all
  double rho = UnipolarDisc(p, W);
  for (int j = 0; j < 8; ++j) {
    const double w = ControlSize(W, j), room = p.i_max / p.c0 - std::abs(W(j, 0));
    if (room < 0) return 0;
    if (w > 0) rho = std::min(rho, room / w);
  }
  return rho;
}

double CurrentCapacity(const RedistributionProblem& p, const DistributionMatrix& W) {
  std::vector<Amplitude> rows;
  for (int j = 0; j < 8; ++j) rows.push_back({std::abs(W(j, 0)), ControlSize(W, j)});
  return BestCapacity(rows, UnipolarDisc(p, W));
}

double FluxCapacity(const ForceForms& forms, const DistributionMatrix& W) {
  const DistributionMatrix B = forms.flux * W;
  std::vector<Amplitude> rows;
  for (int j = 0; j < 8; ++j) rows.push_back({std::abs(B(j, 0)), ControlSize(B, j)});
  return BestCapacity(rows, std::numeric_limits<double>::infinity());
}

}  // namespace ambrig
