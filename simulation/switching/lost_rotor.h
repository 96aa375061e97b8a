#pragma once
/// Thrown by a run that was told to end when its rotor touches for too long, or whose motion left
/// all bounds.
#include <string>

#include "core/math/no_solution.h"

namespace ambrig {

struct LostRotor : NoSolution {
  LostRotor(const std::string& text, double t) : NoSolution(text), time(t) {}
  double time;  // [s] of the scenario
};

}  // namespace ambrig
