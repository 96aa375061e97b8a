#pragma once
/// Faults that a scenario or a campaign may name: one table of kinds, one of their parameters,
/// walked by the readers and by docs/parameters.md. Source: docs/theory/base_model.md section 6.
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/base/toml.h"

namespace ambrig {

enum class FaultTarget { kCoil, kAxis, kRig };

struct FaultKind {
  std::string_view kind;  // as files write it: "open", "partial-short", ...
  FaultTarget target;
  std::string_view doc;
};

/// One parameter of a kind. `flag`: true or false in files, 1 or 0 here.
struct FaultParameter {
  std::string_view kind, key, unit;
  double lo, hi;
  bool ends_allowed;  // the bounds themselves
  bool flag;
  std::string_view doc;
};

struct FaultSpec {
  double time = 0;
  std::string target;  // "A.coil3", "A.x", "rig"
  std::string kind;
  std::map<std::string, double> parameters;
  std::string where;  // file:line for errors

  double Get(const std::string& key, double fallback) const {
    const auto it = parameters.find(key);
    return it == parameters.end() ? fallback : it->second;
  }
};

std::span<const FaultKind> FaultKinds();
std::span<const FaultParameter> FaultParameters();

/// Comma separated kinds with one of these targets.
std::string FaultKindNames(std::span<const FaultTarget> targets);
/// Reads `kind` (one of `allowed`) and the table `parameters` of a fault; both checked against the
/// tables.
/// @throws InputError with file:line, key, value and what is allowed.
const FaultKind& ReadFaultKind(const TomlTable& t, const std::string& allowed,
                               std::map<std::string, double>* parameters);

}  // namespace ambrig
