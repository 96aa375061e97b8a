#pragma once
/// Reads the kind and the parameters of a fault from a scenario or a campaign, by the rules of the
/// catalogue.
#include <map>
#include <span>
#include <string>

#include "core/base/toml.h"
#include "scenarios/faults/fault.h"

namespace ambrig {

/// Comma separated kinds with one of these targets.
std::string FaultKindNames(std::span<const FaultTarget> targets);
/// Comma separated classes that a fault of the catalogue may be given, each once.
std::string FaultClassNames();

/// Reads `kind` (one of `allowed`) and the table `parameters` of a fault; both checked against the
/// catalogue and, where it says so, against `rig`.
/// @throws InputError with file:line, key, value and what is allowed.
const Fault& ReadFault(const TomlTable& t, const std::string& allowed, const RigParameters& rig,
                       std::map<std::string, double>* parameters);

}  // namespace ambrig
