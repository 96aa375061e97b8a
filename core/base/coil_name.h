#pragma once
/// What a coil is called in files, events and messages.
#include <string>

namespace ambrig {

/// "A.coil1" of the first coil of bearing A: `coil` counts from 0, the name from 1.
inline std::string CoilName(const std::string& bearing, int coil) {
  return bearing + ".coil" + std::to_string(coil + 1);
}

inline bool NamesCoil(const std::string& target) { return target.find(".coil") != target.npos; }

}  // namespace ambrig
