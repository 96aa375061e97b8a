#pragma once
/// Everything that is known of the coils of a bearing at the end of a period, and what it says of a
/// coil that stands out. Refers to its parts: valid within one period.
#include "fdd/commissioned/coil_currents.h"
#include "fdd/commissioned/commissioned_range.h"
#include "fdd/commissioned/excess_ratios.h"
#include "fdd/commissioned/touch_monitor.h"
#include "fdd/diagnosis.h"

namespace ambrig {

struct CoilEvidence {
  const CommissionedBearing& learnt;
  const SamplingSettings& sampling;
  const ExcessSettings& settings;
  const FluxFilter& filter;
  const FluxPeriod& flux;  // of this period, as the next two
  const SlopeExcess& sums;
  const MeasuredPeriod& in;
  const BelievedTurns& turns;
  const ExcessRatios& ratios;
  const CoilCurrents& currents;
  const CommissionedRange& range;
  const TouchMonitor& touch;
  long long count;  // of periods so far

  const LinkageModel& nominal() const { return filter.nominal(); }
  int coils() const { return filter.nominal().coils; }
  double share(int coil) const { return turns.share[coil]; }
  /// Whether the learnt model holds: usable, and the coils are those it was learnt on.
  bool Relies() const { return learnt.usable(); }
  /// Without a model of this machine, what a rotor that bounces does to the currents is not known.
  bool MayBounce() const { return !Relies() && touch.bounces(); }
  /// Not commissioned, out of the range, or the model's own errors show.
  bool Doubtful() const { return !Relies() || range.left() || ratios.Disturbed(); }

  /// c > 0 from which on the coil is gross: outside the commissioned range larger, unless c became
  /// gross at once [-].
  double GrossAbove(int coil) const;
  /// c of the on and of the off phase have one sign, and the smaller is at
  /// least 0.35 of the larger.
  bool PhasesAgree(int coil) const;
  /// So small an excess is of less than a turn, which no short bypasses.
  bool LessThanATurn(int coil, double excess) const;
  /// Whether the coil is to be blamed for this c: a second indication agrees, and the
  /// model holds or c is gross.
  bool Suffices(int coil, double excess) const;
  /// What has failed of a coil that is blamed; onset [s].
  Diagnosis Classify(int coil, double excess, double onset) const;
};

}  // namespace ambrig
