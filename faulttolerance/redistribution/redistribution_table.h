#pragma once
/// Current distributions of one bearing for every failure set: each is computed once per class of
/// symmetric sets, kept on disk and looked up at run time.
///
/// The cache is one JSON file per bearing and options, named by a hash of both, written under a
/// temporary name and renamed. Entries are checked against the equations when read; a file that is
/// damaged, of another version or not writable is ignored (and rewritten when possible).
/// Partial shorts: turns left are rounded to a grid of 1/20, solved there, and the row of each
/// shorted coil is scaled so that its magnetomotive force, and with it the equations, stay exact.
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "faulttolerance/redistribution/bearing_symmetry.h"
#include "faulttolerance/redistribution/distribution_solver.h"

namespace ambrig {

class RedistributionTable {
 public:
  /// `problem`: the healthy bearing. Empty `cache_dir`: memory only.
  explicit RedistributionTable(const RedistributionProblem& problem,
                               const std::string& cache_dir = {},
                               const DistributionOptions& options = {});

  /// Coils numbered from 1. Computes (seconds) what is not known yet; thread-safe, and the result
  /// does not depend on the order of calls.
  Distribution Lookup(const std::vector<int>& failed) const;
  /// turns_left per coil: 1 healthy, 0 open, 1 - s for a short of the fraction s.
  Distribution Lookup(const CoilVector& turns_left) const;
  /// Best flux-limited capacity of any exact W of the set; of the set's own W when none is exact.
  double FluxCapacity(const std::vector<int>& failed) const;

  const RedistributionProblem& problem() const { return problem_; }
  const std::string& cache_file() const { return file_; }  // empty without cache

 private:
  using Key = std::array<int, 8>;  // turns left in steps of the grid, canonical
  struct Entry {
    SolvabilityClass cls;
    DistributionMatrix W;
    std::optional<double> flux_capacity;
  };

  CoilVector TurnsLeft(const std::vector<int>& failed) const;
  RedistributionProblem AtGrid(const Key& key) const;
  Entry& Find(const Key& key) const;  // mutex held
  void Load() const;
  void Save() const;

  RedistributionProblem problem_;
  DistributionOptions options_;
  std::vector<BearingSymmetry> symmetries_;
  std::string file_;
  mutable std::mutex mutex_;
  mutable std::map<Key, Entry> entries_;
};

/// All 255 non-empty sets, by size, then lexicographic.
std::vector<std::vector<int>> AllFailureSets();

}  // namespace ambrig
