#pragma once
/// The simulations of an explain run on disk: an interrupted one, called again, finds them and goes
/// on where it stopped, with the same bits. Entries are told apart by everything that a prediction
/// depends on; a store of another case or another build is refused.
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/append_file.h"
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
};

class RunStore {
 public:
  /// FOLDER/simulations.bin, begun or gone on with; an entry that was cut off is dropped.
  /// @throws InputError
  RunStore(const std::string& folder, const Case& c);

  /// Of a simulation that is there: its rows are written to `out`; false: it lost its rotor.
  std::optional<bool> Find(const RunKey& key, double* out) const;
  /// Thread-safe. @throws InputError (full disk ...)
  void Keep(const RunKey& key, bool fine, const double* rows);

  std::size_t size() const { return places_.size(); }
  const std::string& path() const { return file_.path(); }

 private:
  struct Place {
    std::size_t offset = 0, rows = 0;
    bool fine = false;
  };
  void ReadAll();

  AppendFile file_;
  std::string begin_;
  std::size_t end_ = 0;  // bytes
  mutable std::mutex mutex_;
  std::map<std::string, Place> places_;
};

}  // namespace ambrig
