#pragma once
/// A scenario's [expect] against what the run gave.
#include <string>
#include <vector>

#include "scenarios/scenario.h"
#include "simulation/record/run_result.h"

namespace ambrig {

struct ExpectResult {
  std::string key, wanted, got;
  bool met = false;
};

std::vector<ExpectResult> CheckExpectations(const Scenario& scenario, const RunResult& result);
bool AllMet(const std::vector<ExpectResult>& results);

}  // namespace ambrig
