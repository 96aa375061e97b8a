#pragma once
/// Gauss-Newton descent over the circuit of a bearing, with its coils fitted to each circuit
/// that is tried: the numerical part of commissioning_fit.h.
#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "fdd/learning/commissioning_rows.h"

namespace ambrig {

/// dx/g0, dy/g0, path, fringing, four residues; two knee terms; run-out over g0.
inline constexpr int kFirstKnee = 8, kFirstRunOut = 10;
inline constexpr int kCircuitParameters = kFirstRunOut + 2 * static_cast<int>(kRunOutTerms);
using CircuitParameters = Eigen::Matrix<double, kCircuitParameters, 1>;
/// Which of them a descent moves: bit k stands for parameter k.
using ParameterSet = std::uint32_t;
/// first, ..., end - 1.
constexpr ParameterSet ParametersFrom(int first, int end) { return (1U << end) - (1U << first); }

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
  /// Descends from p along `moved`; p becomes the best, its cost returned.
  double Descend(CircuitParameters* p, ParameterSet moved, CoilEquations* coils);

 private:
  FluxCircuit Circuit(const CircuitParameters& p) const;
  /// With the slopes of the circuit that was tried last.
  EvaluatedCircuit FitCoils(const CircuitParameters& p) const;
  CoilEquations SolveCoils() const;
  double PriorOf(const CircuitParameters& p) const;
  void Reweight(const std::vector<double>& z);
  void Linearise(const CircuitParameters& p, const std::vector<double>& z,
                 const std::vector<int>& moved);

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
