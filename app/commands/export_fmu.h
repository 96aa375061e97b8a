#pragma once
/// ambrig export --fmu: a rig as a Functional Mock-up Unit for co-simulation.
#include <nlohmann/json.hpp>
#include <string>

namespace ambrig {

struct FmuExport {
  std::string rig, scenario;  // files; without scenario the rig levitates and waits for its inputs
  std::string file;           // NAME.fmu to write
  std::string fmi = "2.0";    // or 3.0
};

/// Writes the FMU and says what is in it. @throws InputError
nlohmann::ordered_json ExportFmu(const FmuExport& wanted);

}  // namespace ambrig
