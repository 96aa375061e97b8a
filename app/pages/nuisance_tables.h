#pragma once
/// What an explanation found to differ without being an effect.
#include <vector>

#include "app/pages/html.h"
#include "discovery/model/nuisances.h"

namespace ambrig {

/// Tables of what differs from record to record, and of the errors of single coils, a row for each
/// bearing and kind; what is within two of its sd is left out.
void AddNuisances(HtmlReport& report, const std::vector<NuisanceFound>& nuisances);

}  // namespace ambrig
