#pragma once
/// From a misfit to the missing effect: base fit, screening, full fits of the best, decision on
/// unseen records, repetition, backward check, verdict. Method: docs/theory/discovery.md.
#include <atomic>
#include <functional>
#include <string>

#include "discovery/decision/explanation.h"
#include "discovery/model/run_store.h"

namespace ambrig {

struct ExplainOptions {
  int candidates = 5;  // fitted in full per round
  int rounds = 3;
  std::function<void(double, const std::string&)> progress;
  bool tell_runs = false;  // the progress text ends with the number of record simulations so far
  std::function<void(const Explanation&)> checkpoint;  // results as they come
  const std::atomic<bool>* stop = nullptr;
  RunStore* store = nullptr;  // simulations of an earlier, interrupted call
  // with the stored table (discovery/calibration/calibration.h), where enough cases stand behind it
  bool calibrate = true;
  bool clocks = true;  // clocks of records that are off are set right first
  int inputs = 2;      // times that the records' inputs are simulated at the sizes found
};

Explanation Explain(const Case& c, const ExplainOptions& options);

}  // namespace ambrig
