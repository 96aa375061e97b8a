#pragma once
/// Everything that `ambrig analyze` asks of a rig, in one go.
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "analysis/api617.h"
#include "analysis/campbell.h"
#include "analysis/dynamic_stiffness.h"
#include "analysis/load_capacity.h"
#include "analysis/rotor_supports.h"
#include "analysis/sensitivity.h"
#include "analysis/unbalance_response.h"

namespace ambrig {

struct AnalysisOptions {
  double lowest = 0, highest = 0;  // operating speeds [rad/s]
  double fastest = 0;              // end of the Campbell diagram and the sweeps [rad/s]
  std::vector<std::pair<std::string, std::string>> responses;  // input, output channel
  int measured = 0;  // frequencies per axis at which the switching engine is asked
  double sine = 0;   // [N] of those; 0: a hundredth of the axis' capacity
  std::function<void(double, const std::string&)> progress;
  const std::atomic<bool>* stop = nullptr;
};

/// ISO 14839-2 of one bearing: orbits of the unbalance cases over its least clearance.
struct DisplacementRow {
  std::string bearing, unbalance;
  double largest = 0, clearance = 0;  // [m] over the operating speeds; of the auxiliary bearing
  char zone = 'A';
};

struct SeparationRow {
  std::string bearing, unbalance;
  ResponsePeak peak;
  SeparationMargin margin;
};

struct ResponseCurve {
  std::string input, output, unit;
  std::vector<double> frequency;             // [Hz]
  std::vector<std::complex<double>> values;  // output unit per input unit
};

/// |S| that the nonlinear switching rig shows under an injected sine.
struct MeasuredPoint {
  std::size_t axis = 0;
  double frequency = 0;  // [Hz]
  std::complex<double> measured, computed;
};

struct RigAnalysis {
  AnalysisOptions options;
  OperatingPoint point;
  std::vector<AxisCapacity> capacity;
  RotorOnSupports supports;
  std::vector<Sensitivity> sensitivity;  // at rest, then at the operating speeds
  std::vector<ClosedLoopModes> rows;     // over speed
  std::vector<ModeTrack> tracks;
  std::vector<DampedCritical> criticals;
  std::vector<UnbalanceSweep> unbalance;
  std::vector<DisplacementRow> displacement;
  std::vector<SeparationRow> separation;
  DynamicStiffness stiffness;            // at rest
  std::vector<ResponseCurve> responses;  // at the highest operating speed
  std::vector<MeasuredPoint> measured;   // at rest
  bool stable() const;                   // at every speed looked at
};

/// @throws InputError for speeds and channels that make no sense, Interrupted when stopped.
RigAnalysis Analyse(const RigParameters& rig, const AnalysisOptions& options);

}  // namespace ambrig
