#pragma once
/// Predictions of single records kept in memory. A record is found again by what it depends on: a
/// clamped record does not feel the rotor, a record at rest no unbalance. Thread-safe.
#include <cstddef>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "discovery/case/case.h"

namespace ambrig {

/// The exact values of all that this record feels of a hypothesis (toleranced parameters, effects).
std::string MemoKey(const RigParameters& rig, const CaseRecord& record, std::size_t index);

class RunMemo {
 public:
  explicit RunMemo(std::size_t most_bytes = 128'000'000) : most_(most_bytes) {}

  /// Rows written to `out`; false: the rotor was lost; nullopt: not known.
  std::optional<bool> Find(const std::string& key, double* out) const;
  void Clear();
  void Keep(const std::string& key, bool fine, const double* rows, std::size_t count);

 private:
  struct Entry {
    std::string key;
    bool fine = false;
    std::vector<double> rows;
  };
  std::size_t most_, bytes_ = 0;
  mutable std::mutex mutex_;
  mutable std::list<Entry> entries_;  // last used first
  std::map<std::string, std::list<Entry>::iterator> places_;
};

}  // namespace ambrig
