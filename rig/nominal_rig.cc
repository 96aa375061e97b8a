#include "rig/nominal_rig.h"

namespace ambrig {

namespace {

RigParameters WithoutCalibration(RigParameters rig) {
  for (Tolerance& t : rig.tolerances) t.true_value = kRequired;
  for (BearingParameters& b : rig.bearings) b.coil_errors = CoilErrors{};
  return rig;
}

}  // namespace

NominalRig::NominalRig(RigParameters rig)
    : rig_(std::make_shared<const RigParameters>(WithoutCalibration(std::move(rig)))) {}

}  // namespace ambrig
