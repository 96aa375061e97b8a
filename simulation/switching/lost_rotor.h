#pragma once
/// Thrown by a run that was told to end when its rotor touches for too long.
#include <stdexcept>
#include <string>

namespace ambrig {

struct LostRotor : std::runtime_error {
  LostRotor(const std::string& text, double t) : std::runtime_error(text), time(t) {}
  double time;  // [s] of the scenario
};

}  // namespace ambrig
