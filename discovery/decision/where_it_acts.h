#pragma once
/// Evidence for a further effect from the channels in which it acts. What the law of an earlier
/// effect leaves in detail lies in that effect's channels; an effect of a single coil or sensor
/// acts in others, and explains nearly all that is left there, however little that is of the whole;
/// or it does in records that feel no earlier effect.
#include "discovery/search/fit.h"

namespace ambrig {

/// Whether `after`, one more effect, explains nearly all that is left where it acts, by more than
/// chance: `score_gain` as WorthAdopting. Of the `first` effect more is asked, as the rig's
/// parameters have not made room for what else is missing.
bool ExplainsItsChannels(const CaseModel& model, const FitResult& before, const FitResult& after,
                         double score_gain, bool first);

}  // namespace ambrig
