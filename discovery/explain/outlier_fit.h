#pragma once
/// Rows where model and machine took different branches, for example because a limiter held one
/// period longer: fits and decisions without them.
#include "discovery/explain/nuisance_selection.h"
#include "discovery/explain/search_models.h"

namespace ambrig {

/// A fit without the rows where errors are large, few and together tells where the parameters may
/// be; of what it allows, the point whose simulation takes the machine's branch most is the start
/// of a fit with all rows. `now` becomes that fit where it is better.
void FitPastOutliers(SearchModels& models, FitResult& now);

/// Nothing is fitted to unseen records: where their outliers vanish for one of the hypotheses that
/// the fitted records allow, these rows tell no law from another and do not count. `now` becomes
/// the same point without them. Whether there were any.
bool PassOverOutliers(SearchModels& models, NuisanceSelection& nuisances, FitResult& now);

}  // namespace ambrig
