#pragma once
/// What a search has to tell of its way: the steps of the ladder and the warnings.
#include <string>
#include <vector>

#include "discovery/decision/explanation.h"

namespace ambrig {

struct SearchLog {
  std::vector<LadderStep> ladder;
  std::vector<std::string> warnings;

  /// The step `added` ends with this fit.
  void Step(const std::string& added, const FitResult& fit) {
    ladder.push_back({added, fit.ratio_fit, fit.ratio_validate});
  }
  /// The last step ended with this fit instead.
  void LastEndsWith(const FitResult& fit) {
    ladder.back().ratio_fit = fit.ratio_fit;
    ladder.back().ratio_validate = fit.ratio_validate;
  }
  /// Takes back all steps behind the first `count`.
  void BackTo(std::size_t count) { ladder.resize(count); }
  void TakeBackLast() { ladder.pop_back(); }
};

}  // namespace ambrig
