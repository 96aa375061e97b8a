#pragma once
/// Keys that several kinds of controller share.
#include "control/interface/controller_kind.h"

namespace ambrig {

/// A system as the file gives it in `domain` "s" or "z" (default: `fallback`), sampled at `rate`
/// [Hz].
StateSpace SampledSystem(const TomlTable& t, const StateSpace& s, double rate,
                         const char* fallback);
/// Tables with ascending speeds [rad/s].
void CheckAscending(const TomlTable& t, double before, double speed);
/// What a synthesis on the linear plant has: speeds, weighed planes and modes, the model's order.
void ReadSynthesis(const TomlTable& t, const ControllerNames& names, ControllerParameters& c);

}  // namespace ambrig
