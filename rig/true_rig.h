#pragma once
/// What is simulated: the rig with its calibrated values in place of the nominal ones.
/// Only what builds a plant takes it; controllers and detectors get a NominalRig
/// (rig/nominal_rig.h).
#include <memory>

#include "rig/nominal_rig.h"

namespace ambrig {

class TrueRig {
 public:
  /// The calibrated values of `rig` where its tolerances have some, else the nominal ones.
  explicit TrueRig(const RigParameters& rig);
  /// A rig with nominal values only: the model that a designer computes with. Calibrated
  /// values are ignored.
  static TrueRig AsDrawn(const NominalRig& rig) { return TrueRig(*rig); }

  const RigParameters& operator*() const { return *rig_; }
  const RigParameters* operator->() const { return rig_.get(); }

 private:
  std::shared_ptr<const RigParameters> rig_;
};

/// Whether some number of the rig has a calibrated value beside the nominal one.
bool HasCalibration(const RigParameters& rig);

}  // namespace ambrig
