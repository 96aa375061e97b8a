#include "fdd/learning/commissioning_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/math/box_solver.h"

namespace ambrig {

namespace {

constexpr int kCircuit = 8, kWithKnee = 10;  // parameters of the circuit
constexpr double kHuber = 2;                 // [expected sizes]
constexpr double kKneePays = 0.98;           // of the cost
// Offsets trade against resistances and slow relaxations: only for a model that does not express the plant without.
constexpr double kOffsetPays = 0.7;
constexpr double kWellFitted = 1.5;  // cost of a row, of a model that leaves little but scatter
constexpr int kMostSteps = 25;
// A row in so many counts once against the priors: rows repeat each other, and without the priors
// the fit would follow what noise prefers.
constexpr double kRowsPerPrior = 500;
constexpr double kSettled = 1e-4;  // relative fall of the cost
// priors of a coil: gain, leakage and resistance relative to the nominal, offset over the bus
constexpr double kGainSd = 0.15, kLeakageSd = 0.3, kResistanceSd = 0.12, kOffsetSd = 0.02;
// of dx/g0, dy/g0, path, fringing, residues, knee terms; and the steps of the differences
constexpr double kSd[kWithKnee] = {0.1, 0.1, 0.3, 0.3, 30, 30, 30, 30, 1, 1};
constexpr double kStep[kWithKnee] = {1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-4, 1e-4};
constexpr double kLeast[kWithKnee] = {-0.25, -0.25, -0.2, -0.5, 0, 0, 0, 0, 0, 0};
constexpr double kMost[kWithKnee] = {0.25, 0.25, 1, 2, 100, 100, 100, 100, 10, 10};
// residues of a half-order law whose drop equals the gap's at these frequencies [Hz]
constexpr double kStarts[] = {1e7, 1e5, 3e4, 1e4, 2e3, 400};

using Parameters = Eigen::Matrix<double, kWithKnee, 1>;

FluxCircuit CircuitOf(const Parameters& p, double gap) {
  FluxCircuit c;
  c.dx = p[0] * gap;
  c.dy = p[1] * gap;
  c.path = p[2];
  c.fringing = p[3];
  for (int m = 0; m < kRelaxations; ++m) c.relaxation[static_cast<std::size_t>(m)] = p[4 + m];
  c.knee7 = p[8];
  c.knee15 = p[9];
  return c;
}

Parameters StartAt(double cutoff) {
  Parameters p = Parameters::Zero();
  for (int m = 0; m < kRelaxations; ++m) p[4 + m] = std::sqrt(kRelaxationPoles[m] / cutoff);
  return p;
}

/// How far parameters first .. last - 1 may move to this side.
Eigen::VectorXd LimitOf(const double* limits, const Parameters& p, int first, int last) {
  return Eigen::Map<const Eigen::VectorXd>(limits + first, last - first) -
         p.segment(first, last - first);
}

double HuberCost(double z) {
  const double a = std::abs(z);
  return a < kHuber ? z * z : 2 * kHuber * a - kHuber * kHuber;
}

class Fit {
 public:
  Fit(const LinkageModel& nominal, const SamplingSettings& sampling, const ExcessSettings& settings,
      const CommissioningLog& log)
      : nominal_(nominal),
        rows_(nominal, sampling, settings, log),
        inductance_(FluxFilter(nominal, sampling, {}).inductances()),
        bus_(sampling.amplifier->bus_voltage),
        huber_(rows_.rows().size(), 1.0),
        prior_(static_cast<double>(size()) / kRowsPerPrior) {}

  std::size_t size() const { return rows_.rows().size(); }
  /// From now on the bridges may have offsets.
  void AllowOffsets() { offsets_ = true; }

  /// Coils fitted to this circuit; `z`: residuals over their expected size. Returns the cost.
  double Evaluate(const Parameters& p, std::vector<double>* z, CoilEquations* coils) {
    rows_.FluxSlopes(CircuitOf(p, nominal_.gap_offset[0]), &slopes_);
    return FitCoils(p, z, coils);
  }

  /// The same with the slopes that this circuit had before.
  double FitCoils(const Parameters& p, std::vector<double>* z, CoilEquations* coils) {
    *coils = SolveCoils();
    z->resize(size());
    double cost = PriorOf(p);
    for (std::size_t n = 0; n < size(); ++n) {
      const CommissioningRow& r = rows_.rows()[n];
      const double e = coils->gain[r.coil] * inductance_[r.coil] * slopes_[n] +
                       coils->leakage[r.coil] * r.current + coils->resistance[r.coil] * r.mean -
                       coils->offset[r.coil] - r.voltage;
      (*z)[n] = e * r.weight;
      cost += HuberCost((*z)[n]);
    }
    return cost;
  }

  /// Descends from p along the parameters first .. last - 1; p becomes the best, its cost returned.
  double Descend(Parameters* p, int first, int last, CoilEquations* coils) {
    std::vector<double> z;
    double cost = Evaluate(*p, &z, coils), damping = 1e-3;
    for (int step = 0; step < kMostSteps; ++step) {
      for (std::size_t n = 0; n < size(); ++n)
        huber_[n] = std::min(1.0, kHuber / std::max(std::abs(z[n]), 1e-12));
      // With the coils of the new weights, as the points that the differences are taken to.
      cost = FitCoils(*p, &z, coils);
      Linearise(*p, z, first, last);
      double next = cost;
      for (int tries = 0; tries < 6; ++tries, damping *= 10) {
        Parameters q = *p;
        Eigen::MatrixXd damped = normal_;
        damped.diagonal() *= 1 + damping;
        // A limit holds its parameter while the others move on: cut off one by one they would not
        // agree, and the descent would creep along the limit.
        const Eigen::VectorXd move = SolveInBox(
            damped, -gradient_, LimitOf(kLeast, *p, first, last), LimitOf(kMost, *p, first, last));
        for (int k = first; k < last; ++k)
          q[k] = std::clamp(q[k] + move[k - first], kLeast[k], kMost[k]);
        if (q == *p) break;
        CoilEquations tried;
        std::vector<double> z_tried;
        next = Evaluate(q, &z_tried, &tried);
        if (!(next < cost)) continue;
        *p = q;
        *coils = tried;
        z.swap(z_tried);
        damping = std::max(damping / 10, 1e-6);
        break;
      }
      if (!(next < cost)) break;
      const bool settled = cost - next < kSettled * cost;
      cost = next;
      if (settled) break;
    }
    return cost;
  }

 private:
  double PriorOf(const Parameters& p) const {
    double sum = 0;
    for (int k = 0; k < kWithKnee; ++k) sum += std::pow(p[k] / kSd[k], 2);
    return prior_ * sum;
  }

  CoilEquations SolveCoils() const {
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
      const Eigen::Vector4d x(inductance_[r.coil] * slopes_[n], r.current, r.mean,
                              offsets_ ? -1 : 0);
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

  void Linearise(const Parameters& p, const std::vector<double>& z, int first, int last) {
    const int count = last - first;
    std::vector<std::vector<double>> J(static_cast<std::size_t>(count));
    CoilEquations unused;
    for (int k = 0; k < count; ++k) {
      Parameters q = p;
      const double h = kStep[first + k] * std::max(1.0, std::abs(p[first + k]));
      q[first + k] += h;
      std::vector<double>& column = J[static_cast<std::size_t>(k)];
      Evaluate(q, &column, &unused);
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
      const double prior = prior_ / (kSd[first + a] * kSd[first + a]);
      normal_(a, a) += prior;
      gradient_[a] += prior * p[first + a];
    }
  }

  const LinkageModel& nominal_;
  CommissioningRows rows_;
  Lane inductance_;
  double bus_;  // [V]
  bool offsets_ = false;
  std::vector<double> huber_, slopes_;
  double prior_;  // weight of the priors
  Eigen::MatrixXd normal_;
  Eigen::VectorXd gradient_;
};

struct Found {
  Parameters parameters;
  CoilEquations coils;
  double cost = kInfinity;
};

/// Iron that bends: the knees `first` to `last` alone from a start, then all parameters together where that costs less
/// than `promising`; kept where the end costs less than `most` and than what was found before.
void TryKnees(Fit& fit, Found start, int first, int last, double promising, double most,
              Found* found) {
  if (!(fit.Descend(&start.parameters, first, last, &start.coils) < promising)) return;
  start.cost = fit.Descend(&start.parameters, 0, kWithKnee, &start.coils);
  if (start.cost < std::min(most, found->cost)) *found = start;
}

/// Bridges that add a voltage of their own: again from the start's circuit and from the best found, with offsets.
void TryOffsets(Fit& fit, const Found& straight, Found* found) {
  fit.AllowOffsets();
  const double most = kOffsetPays * found->cost;
  for (Found from : {straight, *found}) {
    from.cost = fit.Descend(&from.parameters, 0, kCircuit, &from.coils);
    if (from.cost < std::min(most, found->cost)) *found = from;
  }
}

}  // namespace

CommissionedBearing FitCommissioning(const std::string& name, const LinkageModel& nominal,
                                     const SamplingSettings& sampling,
                                     const ExcessSettings& settings, const CommissioningLog& log) {
  CommissionedBearing out = NominalBearing(name, nominal);
  Fit fit(nominal, sampling, settings, log);
  if (fit.size() < 100) return out;
  std::vector<double> z;
  Found start{StartAt(kStarts[0]), {}};  // where no start has a cost
  for (const double cutoff : kStarts) {
    Found at;
    at.parameters = StartAt(cutoff);
    at.cost = fit.Evaluate(at.parameters, &z, &at.coils);
    if (at.cost < start.cost) start = at;
  }
  Found straight = start;
  straight.cost = fit.Descend(&straight.parameters, 0, kCircuit, &straight.coils);
  Found found = straight;
  const double most = kKneePays * straight.cost;
  TryKnees(fit, straight, kCircuit, kWithKnee, most, most, &found);
  // Both knees look much alike: a step along both may leave one of them at its limit of 0.
  if (found.cost > kWellFitted * static_cast<double>(fit.size()))
    for (const int knee : {kCircuit, kCircuit + 1})
      for (const Found& from : {straight, start})
        TryKnees(fit, from, knee, knee + 1, kInfinity, most, &found);
  if (found.cost > kWellFitted * static_cast<double>(fit.size())) TryOffsets(fit, straight, &found);
  out.circuit = CircuitOf(found.parameters, nominal.gap_offset[0]);
  out.coils = found.coils;
  out.learnt = true;
  out.rows = static_cast<long long>(fit.size());
  out.grade = found.cost / static_cast<double>(fit.size());
  return out;
}

}  // namespace ambrig
