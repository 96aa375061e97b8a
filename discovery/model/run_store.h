#pragma once
/// The simulations of an explain run on disk (core/base/journal.h): an interrupted one, called
/// again, finds them and goes on where it stopped, with the same bits. Entries are told apart by
/// everything that a prediction depends on; a store of another case or another build is refused.
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/journal.h"
#include "discovery/case/case.h"

namespace ambrig {

/// What one simulation is a function of, for one case.
struct RunKey {
  const RigParameters& rig;
  std::size_t record = 0;
  bool noise = false;
  std::uint64_t seed = 0;
  std::size_t rows = 0;  // predicted
  double horizon = 0;    // [s] up to which it was simulated; 0: to its end
  // the record's, whose sizes a search may set right; none: as the case has them
  const std::vector<Excitation>* inputs = nullptr;
  double start = 0;  // [s] of its first row, which a search may set right, too
};

class RunStore {
 public:
  /// FOLDER/simulations.bin, begun or gone on with; an entry that was cut off is left out.
  /// @throws InputError
  RunStore(const std::string& folder, const Case& c);

  /// Of a simulation that is there, with as many rows as the key has: they are written to `out`;
  /// false: it lost its rotor.
  std::optional<bool> Find(const RunKey& key, double* out) const;
  /// Thread-safe. @throws InputError (full disk ...)
  void Keep(const RunKey& key, bool fine, const double* rows);

  std::size_t size() const { return entries_.size(); }
  const std::string& path() const { return journal_.path(); }

 private:
  struct Entry {
    std::size_t offset = 0, bytes = 0;  // of the rows in the file
    bool fine = false;
  };
  RunStore(const std::string& path, const std::string& begin);
  JournalVisitor Into(const std::string& path, const std::string& begin);

  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;  // by the text of their keys
  Journal journal_;
};

}  // namespace ambrig
