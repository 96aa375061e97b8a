#pragma once
/// The work behind `ambrig practice`: folders of cases, a journal of what explain said of them.
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "campaign/run_rows.h"
#include "core/base/errors.h"
#include "core/base/journal.h"
#include "discovery/practice/practice_result.h"

namespace ambrig {

struct PracticeSetting {
  std::vector<PracticeRig> rigs;
  std::uint64_t seed = 1;
  std::size_t cases = 0;
  std::string folder;
  Shard shard;
};

/// "practice seed 1 rigs 3f2a...": what a journal of this setting begins with; the number of cases
/// may grow.
std::string PracticeHeader(const PracticeSetting& setting);

/// NAME.txt, or NAME-2-of-4.txt of a shard; NAME is "journal" for cases, "plans" for plans.
std::string PracticeJournalName(const std::string& name, const Shard& shard);

/// Gives every entry of the folder's journals of this name to `entry`, which may throw
/// nlohmann::json::exception for one of an earlier version: it does not count. @throws InputError
/// for a journal that begins with another header
void ReadPracticeJournals(const PracticeSetting& setting, const std::string& name,
                          const std::string& header,
                          const std::function<void(const nlohmann::ordered_json&)>& entry);

/// Results of all journals of the folder, by name; the later line of a case counts.
/// @throws InputError for a journal of another setting.
std::map<std::string, PracticeResult> FinishedCases(const PracticeSetting& setting);

/// No draw of this case's laws shows on its rig: the case is left out.
struct PracticeCaseNotMade : InputError {
  using InputError::InputError;
};

/// Numbers of the shard's cases that are not finished.
std::vector<std::size_t> PendingCases(const PracticeSetting& setting,
                                      const std::map<std::string, PracticeResult>& finished);

/// What the folder holds of the files that making these cases writes.
std::vector<std::string> FilesOfCases(const std::string& folder,
                                      const std::vector<std::size_t>& cases);

/// Writes folder/NAME/{rig,case,record-*}.toml, record-*.h5 and folder/NAME.answer.toml.
void WritePracticeCase(const PracticeCase& c, const std::string& folder);

/// Makes the case, unless `make_only` explains it, and returns what was said. An error of explain
/// is a result too (failure). @throws Interrupted, PracticeCaseNotMade
PracticeResult RunPracticeCase(const PracticeSetting& setting, std::size_t number, bool make_only,
                               const std::function<void(double, const std::string&)>& progress);

/// answers.toml: the answers of all cases of the folder in one file.
void JoinAnswers(const std::string& folder);

}  // namespace ambrig
