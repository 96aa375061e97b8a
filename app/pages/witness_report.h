#pragma once
/// Two witnesses of contact as JSON and as one HTML page (simulation/verdict/contact_witness.h).
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "simulation/verdict/contact_witness.h"

namespace ambrig {

struct WitnessedScenario {
  std::string file, name;
  std::uint64_t seed = 1;
  ContactWitness witness;
};

/// "stayed up", "touched down" or "dropped".
std::string VerdictName(const DropFigures& figures);
nlohmann::ordered_json WitnessJson(const WitnessedScenario& scenario);
/// @throws InputError when it cannot be written.
void WriteWitnessReport(const std::vector<WitnessedScenario>& scenarios, const std::string& path);

}  // namespace ambrig
