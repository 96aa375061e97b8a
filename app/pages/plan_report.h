#pragma once
/// The report of `ambrig plan`: the card of the next record, and the scenarios that were compared.
#include <string>

#include "discovery/plan/plan.h"

namespace ambrig {

void WritePlanReport(const Plan& plan, const std::string& subject, const std::string& scenario,
                     const std::string& path);

}  // namespace ambrig
