#pragma once
/// What surrounds the laws of a practice case: sizes of the rig, noise and what the case says of
/// it, nuisances of each record.
#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "discovery/model/case_model.h"
#include "discovery/practice/practice_case.h"

namespace ambrig {

struct Surroundings {
  std::string noise_mode, nuisance_mode;  // as in PracticeCase
  std::map<std::string, double> noise;    // true rms by channel
  std::map<std::string, double> stated;   // what case.toml says
  double current_factor = 1;              // true noise of a current over the rig file's
  double cell_noise = 0;                  // of load cells [N]
  // of each record, by sd: zeros of position sensors [m], size of the commanded signals [-]
  std::map<std::string, double> zero;
  double input_gain = 0, time_shift = 0;  // [-], [s]
};

/// The rig file with another mass, gap and pole area, its controller's gains in proportion.
std::string WithOtherSizes(const std::string& text, const std::string& file, std::uint64_t seed);

Surroundings DrawSurroundings(const RigParameters& rig, std::uint64_t seed);

/// Puts the true noise into the true rig and the case that is to be filled.
void SetTrueNoise(const Surroundings& s, RigParameters& truth, Case& data);

/// Fills every record with what the true rig gives under the record's own nuisances.
void FillRecords(const Surroundings& s, const Hypothesis& truth, std::uint64_t seed,
                 const std::atomic<bool>* stop, Case& data);

/// Answers that count as right for an effect at a target: itself and what no record can tell from
/// it.
std::vector<NamedEffect> RightNames(const std::string& effect, const std::string& target);

std::string PracticeCaseText(const Surroundings& s, const std::vector<ExaminationRecord>& records);
std::string PracticeAnswerText(const PracticeCase& c, std::uint64_t seed);

}  // namespace ambrig
