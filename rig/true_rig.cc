#include "rig/true_rig.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

RigParameters Calibrated(RigParameters rig) {
  const std::vector<Tolerance> tolerances = rig.tolerances;
  for (Tolerance& t : rig.tolerances) t.true_value = kRequired;  // from here on in the values
  for (const Tolerance& t : tolerances)
    if (!std::isnan(t.true_value)) SetParameter(rig, t.path, t.true_value);
  return rig;
}

}  // namespace

TrueRig::TrueRig(const RigParameters& rig)
    : rig_(std::make_shared<const RigParameters>(Calibrated(rig))) {}

bool HasCalibration(const RigParameters& rig) {
  return std::any_of(rig.tolerances.begin(), rig.tolerances.end(),
                     [](const Tolerance& t) { return !std::isnan(t.true_value); });
}

}  // namespace ambrig
