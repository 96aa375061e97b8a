#pragma once
/// Memory and time of what takes many runs, known before it starts.
#include "campaign/campaign_file.h"
#include "discovery/case/case.h"

namespace ambrig {

struct WorkSize {
  double seconds = 0;  // of computing, on all cores together divided by their number
  double bytes = 0;    // at the largest moment
  unsigned cores = 1;
};

/// The runs of a campaign that are still to do; `jobs` 0: all cores.
WorkSize CampaignSize(const Campaign& campaign, std::size_t runs, int jobs);

/// What `explain` will simulate for a case and hold of it. The number of simulations follows from
/// what the data show; this is what cases with an effect to find have taken, within a factor of
/// three.
WorkSize ExplainSize(const Case& c);

/// Says how long it will take when that is more than a minute.
/// @throws InputError when it needs more than nine tenths of the free memory, or more than a day
/// unless `long_runs`.
void CheckWorkSize(const std::string& file, const WorkSize& size, bool long_runs);

}  // namespace ambrig
