#pragma once
/// Whether a plan keeps its promise: one record of a practice case leaves two names open, the plan
/// proposes the next record, the true rig makes it, and explain says which name is the right one
/// with it. The true law is not the catalogue's.
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "discovery/calibration/reliability.h"
#include "discovery/practice/practice_case.h"

namespace ambrig {

/// The record that was planned: its scenario file, and what the true rig gave.
struct PlannedRecord {
  std::string scenario;
  Record measured;
};

struct PromiseTrial {
  std::string name, rig, law;  // of the practice case
  std::string right, other;    // "saturation at A"
  std::string record;          // that was planned, its title
  double before = 0;  // share of the right name in the probability of both, by the first record
  double promise = 0, after = 0;              // by the plan; the same share with its record
  std::string left_out;                       // why there is nothing to tell apart; empty: there is
  std::optional<PlannedRecord> planned = {};  // of a trial that was not left out
  bool found() const { return after > 0.5; }
};

struct PromiseOptions {
  std::size_t first = 0;   // number of the one record of the case that is there already
  int draws = 30;          // simulated records that check a promise
  std::uint64_t seed = 1;  // of the noise of the planned record
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double, const std::string&)> progress;
};

/// `made` hides one effect; `read`: the same case as its files say; @throws Interrupted, InputError
PromiseTrial TryPromise(const PracticeCase& made, const Case& read, const PromiseOptions& options);

/// Trials by what was promised, the highest first; those left out do not count.
struct PromiseBin {
  double from = 0, to = 1;
  Share found;
};
std::vector<PromiseBin> PromisesKept(const std::vector<PromiseTrial>& trials);

}  // namespace ambrig
