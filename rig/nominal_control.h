#pragma once
/// The controller's side of a bearing as its designer makes it: everything from the nominal rig.
#include "control/current/bearing_control.h"
#include "rig/nominal_rig.h"

namespace ambrig {

/// Healthy map of bearing k and one current regulator per coil. `nominal` or a copy of it must
/// outlive the control.
BearingControl MakeBearingControl(const NominalRig& nominal, std::size_t k);

}  // namespace ambrig
