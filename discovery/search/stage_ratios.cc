#include "discovery/search/stage_ratios.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

double ExplainedShare(double before, double after) {
  if (std::isinf(before)) return std::isinf(after) ? 0 : 1;
  const double excess = before * before - 1;
  return excess <= 0 ? 0 : std::clamp((before * before - after * after) / excess, 0.0, 1.0);
}

double StageRatios::Answered() const { return std::max({fit, validate, worst_record / 1.1}); }

namespace {
constexpr double kExcessOfLost = 1e12;  // excess where the rotor is lost: it outweighs every error
}

double ShareOfAllRecords(const StageRatios& before, const StageRatios& after) {
  constexpr double kShows = 1.1;             // ratio from which unseen records have a say
  constexpr double kMostBeyondUnseen = 0.5;  // of the share on them
  const auto excess = [](double ratio) {
    return std::clamp(ratio * ratio - 1, 0.0, kExcessOfLost);
  };
  const double fit = excess(before.fit), unseen = excess(before.validate),
               of_fit = ExplainedShare(before.fit, after.fit),
               of_unseen = ExplainedShare(before.validate, after.validate);
  if (before.validate <= kShows) return of_fit;
  const double together = (fit * of_fit + unseen * of_unseen) / (fit + unseen);
  return std::min(together, of_unseen + kMostBeyondUnseen);
}

}  // namespace ambrig
