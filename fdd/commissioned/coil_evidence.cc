#include "fdd/commissioned/coil_evidence.h"

#include <algorithm>
#include <cmath>

#include "fdd/model/loss_excess.h"

namespace ambrig {

namespace {

constexpr double kOfTheLargest = 0.5;  // |c| of coils that fail at once
constexpr double kAgree = 0.35;        // of the larger phase's c
constexpr double kReversed = -1.2;     // c of a phase: the bridge drives the other way
constexpr double kLeastTurns = 0.95;   // of one turn: what a loss of it may be taken for
constexpr double kCountedTurns = 10;   // a winding of fewer is known by its inductance alone

}  // namespace

bool CoilEvidence::PhasesAgree(int coil) const {
  for (const int periods : {3, 40}) {
    const double on = ratios.windows().OfPhase(coil, 0, periods),
                 off = ratios.windows().OfPhase(coil, 1, periods);
    if (on * off > 0 &&
        std::min(std::abs(on), std::abs(off)) >= kAgree * std::max(std::abs(on), std::abs(off)))
      return true;
  }
  return false;
}

bool CoilEvidence::LessThanATurn(int coil, double excess) const {
  const LinkageModel& m = nominal();
  const double of_coil = std::abs(m.n[coil]);
  return of_coil >= kCountedTurns && excess > 0 &&
         excess * of_coil < kLeastTurns * ExcessOfLoss(m, coil).own;
}

double CoilEvidence::GrossAbove(int coil) const {
  if (!range.left()) return ExcessLimits::kGrossAbove;
  return Relies() && ratios.Sudden(coil) ? ExcessLimits::kGross : range.gross_above()[coil];
}

bool CoilEvidence::Suffices(int coil, double excess) const {
  if (LessThanATurn(coil, excess)) return false;
  const bool gross = excess < -ExcessLimits::kGross || excess > GrossAbove(coil);
  if (Relies() && (!range.left() || gross) && !ratios.Disturbed())
    return PhasesAgree(coil) || currents.IsFalse(coil) || currents.IsMissing(coil);
  if (MayBounce()) return false;
  if (gross && currents.IsMissing(coil)) return true;
  // Inside what was learnt no error of the model is as large: several coils have failed at once.
  // What these make of a healthy neighbour's c is smaller.
  if (Relies() && !range.left() && gross)
    return PhasesAgree(coil) && std::abs(excess) > kOfTheLargest * ratios.LargestNow();
  // A learnt model that was refused errs by a few tenths of c, and in its phases alike; not by half
  // of the turns at once.
  const bool indicated =
      currents.IsFalse(coil) || (learnt.learnt && ratios.Jumped(coil) && PhasesAgree(coil));
  return gross && indicated &&
         (excess < 0 ||
          (ratios.GrossCoils() < ExcessLimits::kCoilsAtOnce && (Relies() || ratios.Jumped(coil))));
}

Diagnosis CoilEvidence::Classify(int coil, double excess, double onset) const {
  Diagnosis d;
  d.coil = coil;
  d.time = in.t + sampling.samples * sampling.step;
  d.onset = onset;
  d.confidence = 1;
  d.excess = excess;
  const double on = ratios.windows().OfPhase(coil, 0, 3),
               off = ratios.windows().OfPhase(coil, 1, 3);
  if (flux.largest[coil] < kConducts) {
    d.cls = FaultClass::kOpen;
  } else if (on < kReversed && std::abs(off) < ExcessLimits::kGross) {
    d.cls = FaultClass::kAmplifierOff;
  } else if (off < kReversed && std::abs(on) < ExcessLimits::kGross) {
    d.cls = FaultClass::kSwitchStuckOn;
  } else if (excess > 0) {
    d.cls = FaultClass::kPartialShort;
    d.fraction = d.ripple_fraction = 1 - 1 / std::sqrt(1 + excess);
  } else if (share(coil) < 1 && excess > -ExcessLimits::kMostRegained && !currents.IsFalse(coil)) {
    // A loop that closes through its own resistance was taken for more turns than it has: of the
    // turns believed to work, a negative part is shorted.
    d.cls = FaultClass::kPartialShort;
    d.fraction = 1 - std::min(1 / share(coil), 1 / std::sqrt(1 + excess));
  } else {
    d.cls = FaultClass::kCurrentSensor;
  }
  return d;
}

}  // namespace ambrig
