#pragma once
/// What a study has evaluated so far (core/base/journal.h): a line per point, appended when it is
/// done. A point whose line is damaged is done again.
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/journal.h"
#include "design/point.h"

namespace ambrig {

class StudyJournal {
 public:
  /// @throws InputError when the folder holds another study or another process writes there.
  StudyJournal(const std::string& folder, const Study& study);

  std::optional<Evaluation> Find(std::size_t candidate, const std::vector<double>& values) const;
  void Add(std::size_t candidate, const std::vector<double>& values, const Evaluation& e);
  std::size_t size() const;
  std::size_t damaged() const { return journal_.damaged(); }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, Evaluation> known_;
  Journal journal_;
};

}  // namespace ambrig
