#include "discovery/practice/loop_margin.h"

#include <fmt/format.h>

#include "analysis/sensitivity.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {
constexpr double kLeastChange = 0.1;  // of the gain of one axis
}

void RequireLoopMargin(const RigParameters& rig) {
  RigParameters bare = rig;
  bare.effects.clear();
  const OperatingPoint point = FindOperatingPoint(bare);
  const Sensitivity s = FindSensitivity(point, TransferFunction(point, ClosedLoop(point, 0)), 0);
  if (!s.stable) throw InputError("the position loops of this rig are unstable");
  for (const AxisSensitivity& a : s.axes)
    if (a.gain_up < 1 + kLeastChange || a.gain_down > 1 - kLeastChange)
      throw InputError(fmt::format("the position loop of {} is all but unstable", a.axis));
}

}  // namespace ambrig
