#pragma once
/// Two independent models of contact as JSON (simulation/crosscheck/contact_crosscheck.h).
#include <nlohmann/json.hpp>
#include <string>

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

}  // namespace ambrig
