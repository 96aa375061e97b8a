#pragma once
/// What a run with contact looks like in a few figures, from the path of the shaft's centre in the
/// radial bearings: first touch, first rebound, peak orbit, whirl, rest, severity.
///
/// Severity: speed of the geometric centre without dimension. Over Omega c (1: synchronous whirl
/// round the whole clearance) it is what the literature calls V_val (abstract of ISMB13, paper 52:
/// "non-dimensionalised velocity of the geometric center", from speed and position data alone; the
/// exact scale is not in the abstract, Omega c is ours). Over √(2 g c), the speed of a free fall
/// through the clearance, it also has a meaning at standstill.
#include <string>
#include <vector>

#include "core/base/parameters.h"
#include "rig/parameters/rig_parameters.h"
#include "simulation/record/run_result.h"

namespace ambrig {

/// Path of the shaft's centre in one radial bearing with an auxiliary bearing.
struct CentrePath {
  std::string bearing;
  double clearance = 0;      // [m]
  std::vector<double> x, y;  // [m], one row each
};

struct DropPaths {
  double rate = 0, start = 0;  // [Hz], [s]
  std::vector<CentrePath> bearings;
  std::vector<double> Omega;  // [rad/s]
  double TimeAt(std::size_t row) const { return start + static_cast<double>(row) / rate; }
};

enum class ContactWhirl { kNone, kForward, kBackward };

struct DropFigures {
  bool touchdown = false, drop = false;  // the run's verdict
  std::string first;                     // bearing that is touched first; empty: none
  double touchdown_time = -1;            // [s] its crossing of the clearance, -1: none; a resting
                                         // start touches from the first row on
  double rebound = 0;     // [m] clearance regained there between first and second contact
  double peak_orbit = 0;  // [m] largest radius in any bearing after the touch
  double turns = 0;       // [rev] of the centre round the clearance there, positive with Omega
  ContactWhirl whirl = ContactWhirl::kNone;  // by the sign of `turns`, from half a turn on
  std::vector<std::array<double, 2>> rest;   // [m] mean (x, y) per bearing, last tenth of the run
  double severity = 0;                       // peak centre speed over Omega c [-], 0 at standstill
  double fall_severity = 0;  // peak centre speed over √(2 g c) [-], 0 without gravity across
};

/// @throws std::logic_error when the record has no centre paths (a clamped run).
DropPaths CentrePaths(const RigParameters& rig, const Record& record);
DropFigures MakeDropFigures(const RigParameters& rig, const RunResult& run, const DropPaths& paths);

/// First time at which two runs' centres are further apart than `share` of the clearance in any
/// bearing [s]; -1: never.
double PartingTime(const DropPaths& a, const DropPaths& b, double share);

const char* WhirlName(ContactWhirl whirl);

}  // namespace ambrig
