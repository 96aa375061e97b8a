#pragma once
/// Everything that `ambrig analyze` computes of a shaft on supports without magnetic bearings; the
/// whole beam, whatever `modes` its file keeps for runs in time.
#include <atomic>
#include <optional>

#include "analysis/shaft/cross_coupling.h"
#include "analysis/shaft/harmonic_response.h"
#include "analysis/shaft/rod_modes.h"
#include "analysis/shaft/shaft_campbell.h"
#include "analysis/shaft/shaft_scatter.h"
#include "analysis/shaft/shaft_unbalance.h"

namespace ambrig {

/// A plane of a shaft by name (disk, station, support) or by its z; a housing by name.
struct PlaneChoice {
  std::string text;
};

struct UnbalanceChoice {
  PlaneChoice plane;
  double magnitude = 0;  // [kg m]
  double phase = 0;      // [rad]
};

struct ForceChoice {
  PlaneChoice plane;
  double x = 0, y = 0;  // [N]
  double phase = 0;     // [rad]
};

struct ShaftOptions {
  double lowest = 0, highest = 0, fastest = 0;  // [rad/s]
  int modes = 10;                               // damped modes
  bool campbell_alone = false;                  // nothing but the damped modes over the speed
  std::vector<UnbalanceChoice> unbalance;       // one set; empty: `grade`, or API 617
  double grade = 0;                             // ISO 21940-11 [m/s]
  std::vector<PlaneChoice> probes;              // empty: supports, disks, housings
  std::vector<ForceChoice> forces;              // harmonic, at the highest speed
  double ground_x = 0, ground_y = 0;            // harmonic motion of the ground [m]
  PlaneChoice coupled;                          // plane of the cross-coupling
  double coupling = 0;                          // Q_A [N/m], 0: not looked at
  int rotors = 0;                               // of the scatter
  std::uint64_t seed = 1;
  std::function<void(double, const std::string&)> progress;
  const std::atomic<bool>* stop = nullptr;
};

struct ShaftAnalysis {
  std::string name;
  BeamFile file;
  BeamRotor beam;
  ShaftOptions options;
  RotorTotals totals;
  std::vector<double> free;  // bending frequencies without supports [rad/s]
  ShaftCampbell campbell;
  std::vector<CriticalSpeed> undamped;  // with the supports as at the highest speed
  std::vector<CriticalMapRow> map;      // every support of the shaft at one stiffness
  std::vector<ShaftSweep> unbalance;
  std::optional<HarmonicSweep> harmonic;
  StaticDeflection weight;
  std::vector<RodMode> axial, torsional;
  std::optional<Level1> level1;
  std::optional<ShaftScatter> scatter;
  std::vector<std::string> notes;
};

/// `tolerances` of the file. @throws InputError for planes and speeds that make no sense,
/// Interrupted when stopped.
ShaftAnalysis AnalyseShaft(const std::string& name, const BeamFile& file,
                           const std::vector<Tolerance>& tolerances, const ShaftOptions& options);

/// Supports of the shaft at stiffness k after k, everything else as it stands (housings, bearings
/// and couplings between shafts); undamped.
std::vector<CriticalMapRow> MapCriticalSpeeds(const BeamRotor& beam,
                                              const std::vector<double>& stiffnesses, int count);

}  // namespace ambrig
