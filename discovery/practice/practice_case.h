#pragma once
/// Practice cases: rigs whose laws are not the catalogue's (laws/practice_law.h), with random
/// parameters, noise that the case states rightly, not at all or wrongly, nuisances of each record,
/// and logger's mistakes; numbered, so that any of them can be made anywhere.
#include <atomic>
#include <string>
#include <vector>

#include "discovery/experiment/examination.h"
#include "discovery/practice/case_score.h"

namespace ambrig {

struct PracticeRig {
  std::string name, file, text;  // of the rig file; names of files inside absolute
};

struct PracticeCase {
  std::string name;       // "case-0007"
  std::string kind;       // one | two | three | unknown | nothing | data
  std::string rig;        // name, with ", other size" where sizes are sampled
  std::string noise;      // stated | not stated | wrongly stated
  std::string nuisances;  // none | declared | not declared
  std::string mistake;    // of the logger, in words; empty: none
  std::vector<std::string> laws, families;
  bool for_fit = false;  // calibration is fitted with it; else checked
  Answer answer;
  double worst_ratio = 0;  // change over the noise that the laws make, worst channel
  std::vector<ExaminationRecord> records;
  Case data;
  RigParameters
      truth;  // parameters, laws and noise of the true rig, without the records' nuisances
  std::string rig_text, case_text, answer_text;  // of rig.toml, case.toml, answers
};

/// Kind of case number `number` (0: first): of 20 cases 9 have one effect, 2 two, 1 three, 2
/// physics outside the catalogue, 2 nothing, 4 wrong data.
std::string KindOfPracticeCase(std::size_t number);

/// "case-0007"
std::string NameOfPracticeCase(std::size_t number);

/// Whether calibration is fitted with this law family (else it is checked with it).
bool FamilyIsForFit(const std::string& family);

/// Makes case `number`. Laws that these records do not show or that lose the rotor are sampled
/// again.
/// @throws InputError when no rig or law works, Interrupted when `stop` is set.
PracticeCase MakePracticeCase(const std::vector<PracticeRig>& rigs, std::uint64_t seed,
                              std::size_t number, const std::atomic<bool>* stop = nullptr);

}  // namespace ambrig
