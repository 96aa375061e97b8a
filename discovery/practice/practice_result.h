#pragma once
/// What explain said of practice cases against what they hide: hit rates, coverage of the sets,
/// reliability of the probabilities.
#include <map>
#include <string>
#include <vector>

#include "discovery/calibration/calibration.h"
#include "discovery/calibration/reliability.h"
#include "discovery/practice/practice_case.h"

namespace ambrig {

/// A practice case that explain has finished.
struct PracticeResult {
  std::string name, kind, rig, noise, nuisances, mistake;  // as in PracticeCase
  std::vector<std::string> laws, families;
  bool for_fit = false;
  double worst_ratio = 0;
  Answer answer;
  Finding finding;
  StatedAnswer stated;         // not calibrated
  std::vector<SetMember> set;  // 95 %, not calibrated
  std::string failure;         // explain's error; empty: none
};

PracticeResult ResultOf(const PracticeCase& c, const Explanation& e);

/// Whether a member ("quiet", "none" and "parameters" are one) is a right answer. Of several
/// effects each one is.
bool IsRightAnswer(const Answer& answer, const std::string& effect, const std::string& target);

/// A result with the probabilities of a calibration, or as computed (nullptr).
struct JudgedResult {
  JudgedStatement best;  // the most probable member
  bool in_set = false;   // a right answer is in the 95 % set
  std::size_t set_size = 0;
};
JudgedResult JudgeResult(const PracticeResult& r, const CalibrationTable* table);

/// Counts of one kind of case.
struct PracticeCount {
  std::string kind;
  Share right, verdict, in_set;
  double mean_set = 0;  // members of the 95 % set
};

struct PracticeSummary {
  std::size_t cases = 0, failed = 0;
  std::vector<PracticeCount> counts;  // all first, then by kind
  std::vector<ReliabilityBin> bins;
  CalibrationError error;
  Share data_recognised;
  std::size_t named_from_wrong_data = 0;  // an effect with a probability above one half
  std::map<std::string, std::map<std::string, int>> by_family, by_mistake;  // -> what was said
};

PracticeSummary Summarise(const std::vector<PracticeResult>& results,
                          const CalibrationTable* table);

/// For MakeCalibration; results that failed are left out.
std::vector<CalibrationCase> CalibrationCases(const std::vector<PracticeResult>& results);

/// "saturation at A + unbalance at B", or the verdict.
std::string SaidText(const PracticeResult& r);
std::string HiddenText(const PracticeResult& r);

}  // namespace ambrig
