#pragma once
/// What `ambrig commission` tells: text, JSON, one HTML page.
#include <nlohmann/json.hpp>
#include <string>

#include "simulation/commissioning/commission.h"

namespace ambrig {

/// What the bands of one coil let through, by the learnt bands: a share s of the turns bypassed
/// makes c = 0.9 (1/(1 - s)^2 - 1), the mutual part taken as a tenth; of a thrust winding three
/// quarters of that.
struct Detectable {
  double smallest_short = 0, smallest_delay = 0;  // share of the turns [-], [s]
  double tenth_delay = -1;                        // of a tenth of the turns [s], -1: not found
  double open_delay = 0;                          // [s]
};
/// `of_loss`: c of this coil over a small loss of turns (fdd/model/loss_excess.h).
Detectable DetectableIn(const CommissionedBearing& b, int coil, double period, double of_loss = 2);

/// Inductance that a coil's ripple sees, rotor centred [H].
double RippleInductance(const RigParameters& rig, const CommissionedBearing& b, int coil);

nlohmann::ordered_json CommissionJson(const RigParameters& rig, const CommissioningResult& result);
std::string CommissionText(const RigParameters& rig, const CommissioningResult& result);
void WriteCommissionReport(const RigParameters& rig, const CommissioningResult& result,
                           const std::string& file);

}  // namespace ambrig
