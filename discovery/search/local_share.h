#pragma once
/// The share of the error that falls in the channels where an effect acts: what the law of an
/// earlier effect leaves in detail lies in that effect's channels, an effect of a single coil or
/// sensor acts in others.
#include <functional>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

struct LocalShare {
  double before = 0;        // ratio of the fitted channels where the error falls most
  double explained = 0;     // share of their error above the noise
  double unseen = 0;        // the same share of these channels in unseen records
  bool seen_there = false;  // whether these show an error to explain
};

/// `before`, `after`: errors over the floor, rows of the model [-]. Only records that `looks_at`
/// holds for; none: all.
LocalShare ShareWhereItActs(const CaseModel& model, const std::vector<double>& before,
                            const std::vector<double>& after,
                            const std::function<bool(std::size_t record)>& looks_at = {});

}  // namespace ambrig
