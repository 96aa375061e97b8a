#pragma once
/// Simulation and experiment of the slope detector's paper, repeated from a folder
/// (examples/paper):
///   step_2mH.toml, step_1mH.toml   a step of 1 A on two coils, its figures 4 and 5
///   healthy.toml                   pulses on a healthy coil, figure 11 and the error analysis
///   open.toml, short.toml          the two faults under the same pulses, figures 12 to 20
/// and what follows from a converter of 8 to 16 bits.
#include <array>
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "simulation/paper_bench/slope_bench.h"

namespace ambrig {

inline constexpr double kPaperMargin = 700;               // [A/s] error budget of its section 4.1
inline constexpr double kPaperCycle = 1.75e-3;            // [s] of the algorithm in its processor
inline constexpr double kPaperInductanceChange = 1.1e-5;  // [H] by the gap, its section 4.1

/// Of a fault: when the detector flags it, the coil's bridge is switched off, which is how fault
/// tolerance begins; the others of a bearing would now take over.
struct PaperRun {
  RigParameters rig;
  Scenario scenario;  // as its file has it
  RunResult result;
  SlopeSeries slopes;
  DetectorLooks look;      // cycles begin with the record
  DiagnosisDelays delays;  // of the runs with a fault
};

/// What one error source does to the mean slope of an otherwise ideal coil [A/s].
struct SlopeErrors {
  double analogue = 0;  // 20 mV
  double bus = 0;       // 1 V
  double gap = 0;       // kPaperInductanceChange, the larger of both directions
  double shift = 0;     // displacement that makes it [m]
};

struct ConverterRow {
  int bits = 0;
  double step = 0;                       // of one code over one sampling interval [A/s]
  double rms = 0;                        // of k̄ about its mean over the healthy periods [A/s]
  double largest = 0;                    // distance from the middle of Eq. 9 [A/s]
  std::size_t outside = 0, periods = 0;  // periods outside Eq. 9 by more than the margin
  DiagnosisDelays open, shorted;
};

struct PaperStudy {
  std::array<PaperRun, 2> steps;  // 2 mH, 1 mH
  PaperRun healthy, open, shorted;
  SlopeRange theory;     // Eq. 9 at i0 = 0.5 A
  SlopeRange simulated;  // ends of the on-phase of the ideal coil
  double i0 = 0;         // where that on-phase started [A]
  SlopeErrors errors;
  double bus_peak = 0;     // largest deviation of the bus from its nominal value, healthy [V]
  double half_spread = 0;  // half of the range of k̄ over the healthy periods [A/s]
  std::vector<ConverterRow> converters;
};

struct PaperStudyOptions {
  std::vector<int> bits{8, 10, 12, 14, 16};
  std::function<void(double)> progress;
  const std::atomic<bool>* stop = nullptr;
};

/// @throws InputError for a folder that does not hold these scenarios, Interrupted when stopped.
PaperStudy RunPaperStudy(const std::string& folder, const PaperStudyOptions& options);

}  // namespace ambrig
