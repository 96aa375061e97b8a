#pragma once
/// Two independent models of contact as JSON and as one HTML page (simulation/crosscheck/contact_crosscheck.h).
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "simulation/crosscheck/contact_crosscheck.h"

namespace ambrig {

struct CrosscheckedScenario {
  std::string file, name;
  std::uint64_t seed = 1;
  ContactCrosscheck crosscheck;
};

/// "stayed up", "touched down" or "dropped".
std::string VerdictName(const DropFigures& figures);
nlohmann::ordered_json CrosscheckJson(const CrosscheckedScenario& scenario);
/// @throws InputError when it cannot be written.
void WriteCrosscheckReport(const std::vector<CrosscheckedScenario>& scenarios,
                           const std::string& path);

}  // namespace ambrig
