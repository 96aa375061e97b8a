#include "fdd/learning/circuit_fit.h"

#include <algorithm>
#include <cmath>

#include "core/math/box_solver.h"

namespace ambrig {

namespace {

constexpr double kHuber = 2;  // [expected sizes]
constexpr int kMostSteps = 25;
// A row in so many counts once against the priors: rows repeat each other, and without the priors
// the fit would follow what noise prefers.
constexpr double kRowsPerPrior = 500;
constexpr double kSettled = 1e-4;  // relative fall of the cost
// priors of a coil: gain, leakage and resistance relative to the nominal, offset over the bus
constexpr double kGainSd = 0.15, kLeakageSd = 0.3, kResistanceSd = 0.12, kOffsetSd = 0.02;

/// Prior, step of the differences and limits of a parameter.
struct ParameterRange {
  double sd, step, least, most;
};
constexpr ParameterRange ParameterRangeOf(int k) {
  if (k < 2 || k >= kFirstRunOut) return {0.1, 1e-3, -0.25, 0.25};  // zeros, run-out
  if (k == 2) return {0.3, 1e-3, -0.2, 1};                          // path
  if (k == 3) return {0.3, 1e-3, -0.5, 2};                          // fringing
  if (k < kFirstKnee) return {30, 1e-3, 0, 100};                    // residues
  return {1, 1e-4, 0, 10};                                          // knees
}

std::vector<int> MembersOf(ParameterSet set) {
  std::vector<int> out;
  for (int k = 0; k < kCircuitParameters; ++k)
    if (set >> k & 1U) out.push_back(k);
  return out;
}

/// How far the parameters may move to this side.
Eigen::VectorXd LimitOf(double ParameterRange::*limit, const CircuitParameters& p,
                        const std::vector<int>& moved) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(moved.size()));
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    const int at = moved[static_cast<std::size_t>(k)];
    out[k] = ParameterRangeOf(at).*limit - p[at];
  }
  return out;
}

double HuberCost(double z) {
  const double a = std::abs(z);
  return a < kHuber ? z * z : 2 * kHuber * a - kHuber * kHuber;
}

}  // namespace

CircuitParameters StartAt(double cutoff) {
  CircuitParameters p = CircuitParameters::Zero();
  for (int m = 0; m < kRelaxations; ++m) p[4 + m] = std::sqrt(kRelaxationPoles[m] / cutoff);
  return p;
}

FluxCircuit CircuitOf(const CircuitParameters& p, double gap) {
  FluxCircuit c;
  c.dx = p[0] * gap;
  c.dy = p[1] * gap;
  c.path = p[2];
  c.fringing = p[3];
  for (int m = 0; m < kRelaxations; ++m) c.relaxation[static_cast<std::size_t>(m)] = p[4 + m];
  c.knee7 = p[kFirstKnee];
  c.knee15 = p[kFirstKnee + 1];
  for (std::size_t k = 0; k < kRunOutTerms; ++k) {
    const auto at = kFirstRunOut + static_cast<Eigen::Index>(k);
    c.run_out.x[k] = p[at] * gap;
    c.run_out.y[k] = p[at + static_cast<Eigen::Index>(kRunOutTerms)] * gap;
  }
  return c;
}

CircuitFit::CircuitFit(const LinkageModel& nominal, const SamplingSettings& sampling,
                       const ExcessSettings& settings, const CommissioningLog& log)
    : nominal_(nominal),
      rows_(nominal, sampling, settings, log),
      inductance_(FluxFilter(nominal, sampling, {}).inductances()),
      bus_(sampling.amplifier->bus_voltage),
      huber_(rows_.rows().size(), 1.0),
      prior_(static_cast<double>(size()) / kRowsPerPrior) {}

FluxCircuit CircuitFit::Circuit(const CircuitParameters& p) const {
  return CircuitOf(p, nominal_.gap_offset[0]);
}

EvaluatedCircuit CircuitFit::Evaluate(const CircuitParameters& p) {
  rows_.FluxSlopes(Circuit(p), &slopes_);
  return FitCoils(p);
}

EvaluatedCircuit CircuitFit::FitCoils(const CircuitParameters& p) const {
  EvaluatedCircuit out{std::vector<double>(size()), SolveCoils(), PriorOf(p)};
  for (std::size_t n = 0; n < size(); ++n) {
    const CommissioningRow& r = rows_.rows()[n];
    const double e = out.coils.gain[r.coil] * inductance_[r.coil] * slopes_[n] +
                     out.coils.leakage[r.coil] * r.current + out.coils.resistance[r.coil] * r.mean -
                     out.coils.offset[r.coil] - r.voltage;
    out.z[n] = e * r.weight;
    out.cost += HuberCost(out.z[n]);
  }
  return out;
}

void CircuitFit::Reweight(const std::vector<double>& z) {
  for (std::size_t n = 0; n < size(); ++n)
    huber_[n] = std::min(1.0, kHuber / std::max(std::abs(z[n]), 1e-12));
}

double CircuitFit::Descend(CircuitParameters* p, ParameterSet set, CoilEquations* coils) {
  const std::vector<int> moved = MembersOf(set);
  EvaluatedCircuit best = Evaluate(*p);
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps; ++step) {
    Reweight(best.z);
    // With the coils of the new weights, as the points that the differences are taken to.
    best = FitCoils(*p);
    const double cost = best.cost;
    Linearise(*p, best.z, moved);
    for (int tries = 0; tries < 6; ++tries, damping *= 10) {
      CircuitParameters q = *p;
      Eigen::MatrixXd damped = normal_;
      damped.diagonal() *= 1 + damping;
      // A limit holds its parameter while the others move on: cut off one by one they would not
      // agree, and the descent would creep along the limit.
      const Eigen::VectorXd move =
          SolveInBox(damped, -gradient_, LimitOf(&ParameterRange::least, *p, moved),
                     LimitOf(&ParameterRange::most, *p, moved));
      for (std::size_t k = 0; k < moved.size(); ++k) {
        const ParameterRange range = ParameterRangeOf(moved[k]);
        double& value = q[moved[k]];
        value = std::clamp(value + move[static_cast<Eigen::Index>(k)], range.least, range.most);
      }
      if (q == *p) break;
      EvaluatedCircuit tried = Evaluate(q);
      if (!(tried.cost < cost)) continue;
      *p = q;
      best = std::move(tried);
      damping = std::max(damping / 10, 1e-6);
      break;
    }
    if (!(best.cost < cost) || cost - best.cost < kSettled * cost) break;
  }
  *coils = best.coils;
  return best.cost;
}

double CircuitFit::PriorOf(const CircuitParameters& p) const {
  double sum = 0;
  for (int k = 0; k < kCircuitParameters; ++k) sum += std::pow(p[k] / ParameterRangeOf(k).sd, 2);
  return prior_ * sum;
}

CoilEquations CircuitFit::SolveCoils() const {
  Eigen::Matrix4d A[kLanes];
  Eigen::Vector4d b[kLanes];
  for (int j = 0; j < nominal_.coils; ++j) {
    const double sd[4] = {kGainSd, kLeakageSd * nominal_.leakage[j],
                          kResistanceSd * nominal_.resistance[j], kOffsetSd * bus_};
    const double at[4] = {1, nominal_.leakage[j], nominal_.resistance[j], 0};
    A[j].setZero();
    for (int k = 0; k < 4; ++k) {
      A[j](k, k) = prior_ / (sd[k] * sd[k]);
      b[j][k] = A[j](k, k) * at[k];
    }
  }
  for (std::size_t n = 0; n < size(); ++n) {
    const CommissioningRow& r = rows_.rows()[n];
    const double w = huber_[n] * r.weight * r.weight;
    const Eigen::Vector4d x(inductance_[r.coil] * slopes_[n], r.current, r.mean, offsets_ ? -1 : 0);
    A[r.coil] += w * x * x.transpose();
    b[r.coil] += w * r.voltage * x;
  }
  CoilEquations out;
  for (int j = 0; j < nominal_.coils; ++j) {
    const Eigen::Vector4d found = A[j].ldlt().solve(b[j]);
    out.gain[j] = found[0];
    out.leakage[j] = found[1];
    out.resistance[j] = found[2];
    out.offset[j] = found[3];
  }
  return out;
}

void CircuitFit::Linearise(const CircuitParameters& p, const std::vector<double>& z,
                           const std::vector<int>& moved) {
  const int count = static_cast<int>(moved.size());
  std::vector<std::vector<double>> J(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    CircuitParameters q = p;
    const int at = moved[static_cast<std::size_t>(k)];
    const double h = ParameterRangeOf(at).step * std::max(1.0, std::abs(p[at]));
    q[at] += h;
    std::vector<double>& column = J[static_cast<std::size_t>(k)];
    column = Evaluate(q).z;
    for (std::size_t n = 0; n < size(); ++n) column[n] = (column[n] - z[n]) / h;
  }
  normal_ = Eigen::MatrixXd::Zero(count, count);
  gradient_ = Eigen::VectorXd::Zero(count);
  for (int a = 0; a < count; ++a) {
    const auto& Ja = J[static_cast<std::size_t>(a)];
    for (int b = 0; b <= a; ++b) {
      const auto& Jb = J[static_cast<std::size_t>(b)];
      double sum = 0;
      for (std::size_t n = 0; n < size(); ++n) sum += huber_[n] * Ja[n] * Jb[n];
      normal_(a, b) = normal_(b, a) = sum;
    }
    for (std::size_t n = 0; n < size(); ++n) gradient_[a] += huber_[n] * Ja[n] * z[n];
    const int at = moved[static_cast<std::size_t>(a)];
    const double prior = prior_ / (ParameterRangeOf(at).sd * ParameterRangeOf(at).sd);
    normal_(a, a) += prior;
    gradient_[a] += prior * p[at];
  }
}

}  // namespace ambrig
