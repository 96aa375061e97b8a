#pragma once
/// study.toml: which controllers are compared, what of them may change, what counts.
/// docs/guide/design.md explains it by example.
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scenario.h"
#include "simulation/simulate.h"

namespace ambrig {

/// One number, or several that move together, of a candidate's rig file.
struct DesignVariable {
  std::vector<std::string> paths;  // "controller.kp", "controller.filter[0].frequency"
  double low = 0, high = 0;
  bool logarithmic = false;
  std::vector<double> values;  // instead of a range: every one is tried
  double start = 0;            // the rig file's own

  /// Share of the range, and back.
  double FromUnit(double u) const;
  double ToUnit(double value) const;
};

struct DesignCandidate {
  std::string name, rig_file, rig_text;
  std::vector<DesignVariable> variables;
};

struct StudyScenario {
  std::string name, file, text;
};

enum class FigureKind {
  // of the linear loop, worst over the speeds
  kPeakSensitivity,
  kSettlingTime,
  kNoiseForce,
  kAmplification,
  kOrbit,
  kSettledOrbit,
  kPlaneOrbit,
  kClearanceUsed,
  kPeakCurrent,
  kCopperLoss,
  kContact,
  kTouchdown,
  kDrop,
  kDetectionDelay  // of a scenario
};

struct FigureInfo {
  FigureKind kind;
  std::string_view name, unit, doc;
  bool of_scenario;
};
/// Every figure that a study may name.
const std::vector<FigureInfo>& FigureInfos();

struct FigureSpec {
  std::string name;  // "load step: orbit"
  const FigureInfo* info = nullptr;
  std::size_t scenario = 0;
  std::string plane;      // of the shaft, where the figure is of one: "disk"
  bool objective = true;  // false: a limit only
  std::optional<double> at_most;
};

enum class SearchMethod { kSweep, kOptimise };

struct Study {
  std::string name, file, fingerprint;  // of the file and all that it names
  std::vector<DesignCandidate> candidates;
  std::vector<StudyScenario> scenarios;
  std::vector<FigureSpec> figures;
  std::vector<double> speeds{0};  // of the linear figures [rad/s]
  // of the true shaft's bending modes in the linear figures [-]; the controllers know nothing of
  // them
  std::vector<double> frequency_errors{0};
  SearchMethod method = SearchMethod::kSweep;
  int points = 0;  // sweep: per candidate, beside the start
  // optimise: ways to weigh the objectives, evaluations of each
  int directions = 0, evaluations = 0;
  std::uint64_t seed = 1;
  // [draw][tolerance with sd]: normal deviates; the first is nominal
  std::vector<std::vector<double>> draws{{}};
  Fidelity fidelity = Fidelity::kSwitching;

  std::vector<std::size_t> Objectives() const;
};

/// @throws InputError "file:line: key = value, allowed ..." for every mistake, in the rigs and
/// scenarios too.
Study ReadStudy(const std::string& file);

}  // namespace ambrig
