#pragma once
/// The rows that a commissioning is fitted to: slopes of both phases of every coil, averaged over
/// eight periods, because noise in slopes is an error in the variables and pulls their factors
/// towards zero. Only the slope of the flux depends on the circuit that is tried.
#include "fdd/learning/commissioned_model.h"
#include "fdd/learning/commissioning_log.h"

namespace ambrig {

struct CommissioningRow {
  int coil = 0;
  double current = 0, mean = 0, voltage = 0;  // slope [A/s], [A], [V]
  double weight = 0;                          // 1/(expected size of the residual) [1/V]
};

class CommissioningRows {
 public:
  static constexpr std::size_t kAverage = 8;  // periods of a row

  CommissioningRows(const LinkageModel& nominal, const SamplingSettings& sampling,
                    const ExcessSettings& settings, const CommissioningLog& log);

  const std::vector<CommissioningRow>& rows() const { return rows_; }
  /// Slope of s psi of every row, with this circuit [A/s].
  void FluxSlopes(const FluxCircuit& circuit, std::vector<double>* out) const;

 private:
  LinkageModel nominal_;
  SamplingSettings sampling_;
  const CommissioningLog& log_;
  std::vector<CommissioningRow> rows_;
  struct Place {
    std::size_t block;
    int phase;
  };
  std::vector<Place> places_;
};

}  // namespace ambrig
