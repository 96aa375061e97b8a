#pragma once
/// Probabilities of explain made true: fitted on practice cases whose laws are not the catalogue's.
/// Every name that may be right, "unknown", "parameters" (or none) and "data" among them, has
///   z = a ln p + b_group + c_group . features,   probability = softmax of z
/// p being what explain computed. Groups: names of effects, unknown, quiet (parameters or none),
/// data. The right member's probability is maximised over the practice cases, under a weak prior
/// around "as computed" (a convex problem; Newton).
#include <array>
#include <string>
#include <vector>

#include "discovery/decision/explanation.h"

namespace ambrig {

/// What may be right in a case; `target` empty but for effects. "quiet": parameters or none.
struct StatedMember {
  std::string effect, target;
  double probability = 0;  // as explain computed it
};

inline constexpr std::size_t kCalibrationFeatures = 5;

/// What explain said of a case, as calibration sees it.
struct StatedAnswer {
  std::vector<StatedMember> members;  // candidates, then unknown, quiet, data
  /// Share left unexplained [-], ln of floors left, largest shift of a parameter over 3 sd, ln of
  /// floors before any effect, remainder of another origin (0 or 1); each within 0 to 3.
  std::array<double, kCalibrationFeatures> features{};
};

StatedAnswer StatedAnswerOf(const Explanation& e);

/// Weights of z: ln p; b of unknown, quiet, data; features of unknown; last but one feature of
/// quiet.
inline constexpr std::size_t kCalibrationTerms = 4 + kCalibrationFeatures + 1;
using CalibrationWeights = std::array<double, kCalibrationTerms>;

struct CalibrationTable {
  CalibrationWeights weights{1};
  double least = 0;  // a member of the 95 % set has at least this (conformal.h)
  int cases = 0;     // practice cases behind it
};

/// Fewer cases say too little: explain keeps its own probabilities.
inline constexpr int kCasesForCalibration = 100;

/// The table in the source (calibration_table.cc), made by `ambrig practice --fit`.
const CalibrationTable& StoredCalibration();

/// Probabilities of the members, in their order; they sum to 1.
std::vector<double> CalibratedProbabilities(const CalibrationWeights& weights,
                                            const StatedAnswer& answer);

struct CalibrationCase {
  StatedAnswer answer;
  std::vector<char> right;  // one flag per member
};

/// Most probable weights; cases without a right member teach that "unknown" was right.
CalibrationWeights FitCalibration(const std::vector<CalibrationCase>& cases);

/// Weights, then the conformal threshold, of the same cases.
CalibrationTable MakeCalibration(const std::vector<CalibrationCase>& cases);

/// The members of the 95 % set, most probable first, at least one. `quiet_name`: none or
/// parameters.
std::vector<SetMember> CalibratedSet(const CalibrationTable& table, const StatedAnswer& answer,
                                     const std::string& quiet_name);

/// Replaces the probabilities of the ranking and the 95 % set. The verdict and what was adopted
/// stay.
void Calibrate(const CalibrationTable& table, Explanation& e);

}  // namespace ambrig
