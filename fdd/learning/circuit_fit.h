#pragma once
/// Gauss-Newton descent over the circuit of a bearing, with its coils fitted to each circuit that is tried:
/// the numerical part of commissioning_fit.h.
#include <Eigen/Dense>
#include <vector>

#include "fdd/learning/commissioning_rows.h"

namespace ambrig {

inline constexpr int kCircuitParameters = 8;  // dx/g0, dy/g0, path, fringing, four residues
inline constexpr int kWithKnees = 10;         // and two knee terms
using CircuitParameters = Eigen::Matrix<double, kWithKnees, 1>;

/// Residues of a half-order law whose drop equals the gap's at `cutoff` [Hz], else nothing.
CircuitParameters StartAt(double cutoff);
/// `gap`: nominal [m].
FluxCircuit CircuitOf(const CircuitParameters& p, double gap);

/// What a circuit comes to when its coils are fitted.
struct EvaluatedCircuit {
  std::vector<double> z;  // residuals of the rows over their expected size
  CoilEquations coils;
  double cost = kInfinity;
};

class CircuitFit {
 public:
  CircuitFit(const LinkageModel& nominal, const SamplingSettings& sampling,
             const ExcessSettings& settings, const CommissioningLog& log);

  /// Rows that are fitted.
  std::size_t size() const { return rows_.rows().size(); }
  /// From now on the bridges may have offsets.
  void AllowOffsets() { offsets_ = true; }

  EvaluatedCircuit Evaluate(const CircuitParameters& p);
  /// Descends from p along the parameters first .. last - 1; p becomes the best, its cost returned.
  double Descend(CircuitParameters* p, int first, int last, CoilEquations* coils);

 private:
  FluxCircuit Circuit(const CircuitParameters& p) const;
  /// With the slopes of the circuit that was tried last.
  EvaluatedCircuit FitCoils(const CircuitParameters& p) const;
  CoilEquations SolveCoils() const;
  double PriorOf(const CircuitParameters& p) const;
  void Reweight(const std::vector<double>& z);
  void Linearise(const CircuitParameters& p, const std::vector<double>& z, int first, int last);

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

}  // namespace ambrig
