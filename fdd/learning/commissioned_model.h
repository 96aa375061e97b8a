#pragma once
/// What the commissioning of a healthy bearing found: its circuit, its coils, and how far healthy
/// running came from them. Everything that the commissioned detector knows beside the nominal rig.
#include <algorithm>
#include <string>
#include <vector>

#include "fdd/circuit/slope_excess.h"
#include "rig/parameters/machine_identity.h"

namespace ambrig {

/// Windows over which the statistic is averaged [periods], and the least bands on each.
inline constexpr int kExcessWindows = 5;
inline constexpr int kExcessWindow[kExcessWindows] = {1, 3, 10, 40, 160};
inline constexpr double kExcessFloor[kExcessWindows] = {0.30, 0.15, 0.08, 0.05, 0.04};
/// Bands stand at this many times what healthy running reached.
inline constexpr double kBandOverHealthy = 1.5;
/// Mean square of the fit's residuals over their expected size, above which the model does not
/// express the plant and is refused.
inline constexpr double kWorstGrade = 2.5;

struct CommissionedBearing {
  std::string name;
  std::string
      learnt_on;  // content hash of the nominal bearing and amplifier (commissioning_file.h)
  FluxCircuit circuit;
  CoilEquations coils;
  bool learnt = false;           // false: nominal values with wide bands
  double grade = 0;              // cost per row of the fit [-]
  long long rows = 0;            // of the fit
  Lane largest[kExcessWindows];  // |c| of healthy running, per coil and window [-]
  Lane largest_flux;             // |psi| [A]
  Lane current_error;            // |set-point - mean| over two periods [A]
  double pattern = 0;            // largest common, cos or sin part of c over ten periods [-]

  /// Whether the detector may rely on it.
  bool usable() const { return learnt && grade <= kWorstGrade; }
};

/// The nominal circuit and coils of a bearing that was not commissioned.
inline CommissionedBearing NominalBearing(const std::string& name, const LinkageModel& m) {
  CommissionedBearing b;
  b.name = name;
  for (int j = 0; j < m.coils; ++j) {
    b.coils.gain[j] = 1;
    b.coils.leakage[j] = m.leakage[j];
    b.coils.resistance[j] = m.resistance[j];
  }
  return b;
}

/// Band of |c| of one coil over window w: beyond what healthy running made of it, and beyond a
/// floor that is the same loss of turns for every coil. `of_loss`: its c over a small loss
/// (fdd/model/loss_excess.h).
inline double HealthyBand(const CommissionedBearing& b, int w, int coil, double of_loss) {
  constexpr double kAlone = 2;  // of a coil that shares no core, which the floors are those of
  return std::max(kExcessFloor[w] * of_loss / kAlone, kBandOverHealthy * b.largest[w][coil]);
}

struct CommissionedModel {
  MachineIdentity machine;  // that it was learnt on; not known of files of earlier versions
  std::vector<CommissionedBearing> bearings;

  const CommissionedBearing* Find(const std::string& name) const {
    for (const CommissionedBearing& b : bearings)
      if (b.name == name) return &b;
    return nullptr;
  }
};

}  // namespace ambrig
