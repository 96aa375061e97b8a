#pragma once
/// The nominal values: all that controllers, detectors and the supervisor may know of a rig. The
/// calibrated values of the tolerances are not in it.
#include <memory>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// Copies share the parameters; references into them hold as long as one copy lives.
class NominalRig {
 public:
  explicit NominalRig(RigParameters rig);

  const RigParameters& operator*() const { return *rig_; }
  const RigParameters* operator->() const { return rig_.get(); }

 private:
  std::shared_ptr<const RigParameters> rig_;
};

}  // namespace ambrig
