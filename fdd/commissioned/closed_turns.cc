// What CommissionedDetector makes of shorted turns that close through a resistance.
#include <algorithm>
#include <optional>
#include <utility>

#include "fdd/commissioned/commissioned_detector.h"

namespace ambrig {

namespace {

constexpr double kLeastLoop = 0.3;  // of the turns by the ripple: less does no harm, whatever it is
// Slopes over healthy ones, of what a loop that keeps all flux out of its pole makes of them
constexpr double kLeastOfLoop = 0.6, kMostOfLoop = 2.5;

}  // namespace

bool CommissionedDetector::MayBeLoop(int coil) const {
  const double left = share(coil);
  if (left == 0 || left == 1) return false;
  const LinkageModel& m = filter_.nominal();
  const double steeper = 1 / (left * left),
               of_loop = m.SelfInductanceAt(coil, 0, 0) / m.leakage[coil];
  return closed_[coil] > 0 || (steeper > kLeastOfLoop * of_loop && steeper < kMostOfLoop * of_loop);
}

void CommissionedDetector::FollowCarried(const MeasuredPeriod& in, bool comparable) {
  if (comparable)
    carried_.Keep(in, period_, currents_.mean());
  else
    carried_.Clear();
  if (carried_.moved() && carried_.share() < 1) closed_[carried_.coil()] = 1;
}

void CommissionedDetector::TellCarried(CoilVerdict* out) {
  // Other coils that lost turns, now or before, move the flux of this one, too.
  Diagnosis& d = out->diagnosis;
  if (d.cls != FaultClass::kPartialShort || d.ripple_fraction < kLeastLoop || !AllAreWhole())
    return;
  const bool of_both = !out->more.empty();
  if (of_both && !MayBeLoopOfSide(out)) return;
  const std::optional<double> lost = step_.Lost(d.coil, d.onset, d.ripple_fraction, of_both);
  // Where the instant does not tell which it is, nobody else is blamed for what a loop may do, and
  // one loop is likelier than two windings that fail at one instant.
  const bool loop = !lost || *lost < d.ripple_fraction;
  if (of_both) {
    if (!loop) return;
    closed_[out->more[0].coil] = 1;
    out->beside.swap(out->more);
  }
  closed_[d.coil] = loop ? 1 : 0;
  d.fraction = lost.value_or(of_both ? 0 : d.ripple_fraction);
  carried_.Begin(d.coil, d.onset, 1 - d.fraction, 1 - d.ripple_fraction);
}

bool CommissionedDetector::MayBeLoopOfSide(CoilVerdict* out) const {
  if (out->more.size() != 1) return false;
  Diagnosis &looped = out->diagnosis, &other = out->more[0];
  if (other.cls != FaultClass::kPartialShort || other.ripple_fraction < kLeastLoop ||
      !SharesCore(filter_.nominal(), looped.coil, other.coil))
    return false;
  // The winding whose turns close has lost them, beside the flux that both miss.
  if (other.ripple_fraction > looped.ripple_fraction) std::swap(looped, other);
  return true;
}

bool CommissionedDetector::BesideLoop() const {
  return *std::max_element(closed_.v, closed_.v + kLanes) > 0;
}

bool CommissionedDetector::StandsBesideLoop(const CoilVerdict& out) const {
  if (!BesideLoop()) return true;
  const Diagnosis& d = out.diagnosis;
  if (d.cls == FaultClass::kPartialShort)
    return closed_[d.coil] == 0 && ratios_.Sudden(d.coil) && out.turns == 0 &&
           out.excess > ExcessLimits::kGrossBeside;
  return d.cls != FaultClass::kCurrentSensor && out.turns == 0;
}

}  // namespace ambrig
