#pragma once
/// A number in JSON, which has no word for nan and infinity.
#include <cmath>
#include <nlohmann/json.hpp>

namespace ambrig {

/// The number, or null for one that is not finite.
inline nlohmann::ordered_json FiniteOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace ambrig
