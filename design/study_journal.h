#pragma once
/// What a study has evaluated so far: a line per point, appended when it is done. kill -9 loses no
/// line; a damaged one is found by its check sum and its point is done again.
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/append_file.h"
#include "design/point.h"

namespace ambrig {

class StudyJournal {
 public:
  /// @throws InputError when the folder holds another study or another process writes there.
  StudyJournal(const std::string& folder, const Study& study);

  std::optional<Evaluation> Find(std::size_t candidate, const std::vector<double>& values) const;
  void Add(std::size_t candidate, const std::vector<double>& values, const Evaluation& e);
  std::size_t size() const;
  std::size_t damaged() const { return damaged_; }

 private:
  mutable std::mutex mutex_;
  AppendFile file_;
  std::map<std::string, Evaluation> known_;
  std::size_t damaged_ = 0;
};

}  // namespace ambrig
