#pragma once
/// A fault as a scenario file gives it: when, where, of which kind, with which numbers.
#include <map>
#include <string>

namespace ambrig {

struct FaultSpec {
  double time = 0;     // [s]
  std::string target;  // "A.coil3", "A.x", "rig"
  std::string kind;    // of the catalogue (catalogue.cc)
  std::map<std::string, double> parameters;
  std::string where;  // file:line for errors

  double Get(const std::string& key, double fallback) const {
    const auto it = parameters.find(key);
    return it == parameters.end() ? fallback : it->second;
  }
};

}  // namespace ambrig
