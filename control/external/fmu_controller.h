#pragma once
/// A controller that is a Functional Mock-up Unit: unpacked once per process, run like a
/// controller in C in a process of its own, once per controller period. What belongs to what is
/// written to a small file (a binding, host/fmu_adapter.h) that the process reads.
#include "control/external/external_controller.h"
#include "control/external/fmu_description.h"

namespace ambrig {

struct FmuSettings : ExternalSettings {
  std::string file;    // path of the FMU
  std::string folder;  // where it is unpacked
  FmuInterface fmu;
  std::map<std::string, std::string> variables;  // ambrig's name -> the FMU's, where they differ
};

/// Unpacks and reads `file`; folders are removed when the process ends. @throws InputError
void OpenFmu(FmuSettings& settings);

/// Writes the binding for this rig and returns its path. @throws InputError when a force
/// or current that the rig needs is missing in the FMU, or an input of the FMU is nothing
/// that ambrig measures.
std::string WriteFmuBinding(const FmuSettings& settings, const ControllerSite& site);

}  // namespace ambrig
