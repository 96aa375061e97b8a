#pragma once
/// What `ambrig new` asks of a bench and what it makes of the answers: one row per template.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// One number of a bench.
struct BenchNumber {
  std::string_view key, unit, doc;
  double lo, hi;
  double fallback = kRequired;  // nan: must be answered
};

struct BenchTemplate {
  std::string_view name, doc;
  std::vector<BenchNumber> numbers;
  std::string_view rotor, amplifier, bearings;  // TOML with {key} for the answers
  bool one_axis = false;
};

const std::vector<BenchTemplate>& BenchTemplates();
/// @throws InputError naming all of them
const BenchTemplate& BenchTemplateByName(const std::string& name);

using BenchAnswers = std::map<std::string, double, std::less<>>;

/// The rig file: gains of the position loop follow from the magnets' negative stiffness, by the
/// rule that its comments state. @throws InputError when the numbers contradict each other
std::string RigTextOf(const BenchTemplate& bench, const BenchAnswers& answers);

}  // namespace ambrig
