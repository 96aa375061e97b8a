#pragma once
/// Two independent models of contact as one HTML page (simulation/crosscheck/contact_crosscheck.h).
#include <string>
#include <vector>

#include "app/json/crosscheck_json.h"

namespace ambrig {

/// @throws InputError when it cannot be written.
void WriteCrosscheckReport(const std::vector<CrosscheckedScenario>& scenarios,
                           const std::string& path);

}  // namespace ambrig
