#include "discovery/search/candidate_promise.h"

#include <algorithm>
#include <cmath>

#include "discovery/search/stage_ratios.h"

namespace ambrig {

bool Promising(const FitResult& now, const Candidate& c) {
  const double fall = now.ratio_validate * now.ratio_validate - c.ratio_validate * c.ratio_validate;
  return (fall > 0.012 && ExplainedShare(now.ratio_validate, c.ratio_validate) > 0.17) ||
         ExplainedShare(now.ratio_fit, c.ratio_fit) > 0.3;
}

bool PromisesItsChannels(const LocalShare& share) {
  constexpr double kShows = 1.3, kMost = 0.6;  // ratio there, share of the error
  return share.before > kShows && share.explained > kMost &&
         (!share.seen_there || share.unseen > kMost);
}

double LargestShift(const Hypothesis& h) {
  double most = 0;
  for (std::size_t k = 0; k < h.free.size(); ++k)
    if (h.free[k].effect < 0 && h.free[k].sd > 0) most = std::max(most, std::abs(h.Coordinate(k)));
  return most;
}

}  // namespace ambrig
