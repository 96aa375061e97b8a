#pragma once
/// The variables of a rig as an FMU (Functional Mock-up Interface 2.0 and 3.0, co-simulation): what
/// an importer may set and read, in the order of their value references. Made from the rig's
/// tables, so that exporter and library need not tell each other.
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/faults/fault.h"
#include "simulation/stepped/stepped_run.h"

namespace ambrig {

struct FmuVariable {
  enum class Role {
    kTime,           // value reference 0; FMI 3.0 lists it
    kParameter,      // a number of the rig file by its path
    kSeed,           // of the noise
    kNoise,          // whether there is any
    kFaultTolerant,  // whether detection and redistribution act
    kReference,      // inputs from here on: wanted position of axis `owner`
    kForce,          // added to the controller's force of axis `owner`
    kCurrent,        // added to the set-point of coil `index` of bearing `owner`
    kLoad,           // on the shaft at plane `owner`, direction `index`
    kAcceleration,
    kSpeed,
    kFault,        // becomes true: the fault happens
    kFaultNumber,  // `key` of the fault, read when it happens
    kOutput,       // `owner`: of SteppedRun::outputs()
  };
  enum class Type { kReal, kInteger, kBoolean };

  Role role = Role::kTime;
  Type type = Type::kReal;
  std::string name, unit, words;
  double start = 0, lo = -kInfinity, hi = kInfinity;
  std::size_t owner = 0;
  int index = 0;
  const Fault* fault = nullptr;
  std::string target = {};    // of the fault
  std::string_view key = {};  // of a fault's number
  std::size_t fault_at = 0;   // value reference of the fault that a number belongs to

  bool IsParameter() const { return role >= Role::kParameter && role <= Role::kFaultTolerant; }
  bool IsInput() const { return role >= Role::kReference && role <= Role::kFaultNumber; }
  bool IsOutput() const { return role == Role::kOutput; }
};

/// All of them; a variable's place is its value reference.
std::vector<FmuVariable> FmuVariablesOf(const RigParameters& rig, const Scenario& scenario,
                                        const std::vector<SteppedOutput>& outputs);

/// The scenario of an FMU that was exported without one: a levitated start, then whatever comes in.
Scenario OpenScenario(const RigParameters& rig);

}  // namespace ambrig
