#pragma once
/// Errors of the data of records that are not over time: frequency responses and static tables. A
/// mistake is made on the prediction, point by point, and believed where hardly anything is left of
/// a gross error.
#include <complex>
#include <string>
#include <vector>

#include "discovery/data_gate/data_gate.h"

namespace ambrig {

/// What of a response is wrong beside its size (DataFault::with).
inline constexpr const char *kConjugate = "conjugate", *kPhase = "phase", *kDecibels = "decibels",
                            *kLevels = "levels", *kInverse = "inverse";

/// A response as the gate sees it: points that count only.
struct GateResponse {
  std::size_t index = 0;                                 // in the record's responses
  std::vector<double> frequency;                         // [Hz]
  std::vector<std::complex<double>> measured, expected;  // SI
  std::vector<double> weight;  // 1 over the squared sd of a point over its magnitude
  double floors = 0;           // rms error over the noise; infinity: its sd is not known
  double noise = 0;            // rms of the relative error that noise alone makes
};

/// rms over the points of |m - p| over hypot(|m|, |p|): 0 to the root of two, whatever the sizes
/// are.
double RelativeError(const GateResponse& r, const std::vector<std::complex<double>>& expected);

/// A mistake that leaves so much of the relative error of a response.
struct ResponseMistake {
  std::string fault, with;  // of a DataFault
  double factor = 1, seconds = 0;
  double left = 1;
};

/// The mistake that explains the response best, `fault` empty where none does.
ResponseMistake MistakeOf(const GateResponse& r, bool quotient);

/// Signs, conjugates, inverses, units, phases, decibels and delays of the responses; the unit of
/// their frequencies; outputs of another axis.
void CheckResponses(const CaseModel& model, const std::vector<double>& predicted,
                    const Hypothesis& h, std::size_t record, std::vector<DataFault>& out);

/// Rows of a table with readings or currents that cannot be.
void CheckTableRange(const CaseModel& model, const std::vector<double>& predicted,
                     std::size_t record, std::vector<DataFault>& out);

/// Signs and units of the outputs of a table, and of what was set.
void CheckTable(const CaseModel& model, const std::vector<double>& predicted, const Hypothesis& h,
                std::size_t record, std::vector<DataFault>& out);

}  // namespace ambrig
