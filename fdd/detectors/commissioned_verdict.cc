/// What the commissioned detector says of a coil that stands out: its witnesses, its class.
#include <algorithm>
#include <cmath>

#include "fdd/detectors/commissioned_detector.h"
#include "fdd/model/loss_excess.h"

namespace ambrig {

namespace {

constexpr double kAgree = 0.35;        // of the larger phase's c
constexpr double kReversed = -1.2;     // c of a phase: the bridge drives the other way
constexpr int kMissedTwice = 2;        // periods in a row
constexpr double kMostRegained = 0.9;  // |c|
constexpr double kMoreThanAll = 1.07, kAsGoodAsAll = 0.95;  // of the turns
constexpr double kLeastLost = 0.1;        // of the turns, for coils that fail at once
constexpr double kLeastTurns = 0.95;      // of one turn: what a loss of it may be taken for
constexpr double kCountedTurns = 10;      // a winding of fewer is known by its inductance alone
constexpr long long kOnOneCore = 2500;    // periods after turns were lost on one core: more of them
constexpr int kMostWaited = 10;           // periods, for another coil
constexpr double kAboutToStandOut = 0.5;  // of its band
constexpr int kWindowOfJoint = 1;  // of three periods: what healthy running leaves in as many

}  // namespace

bool CommissionedDetector::PhasesAgree(int coil) const {
  for (const int periods : {3, 40}) {
    const double on = windows_.OfPhase(coil, 0, periods), off = windows_.OfPhase(coil, 1, periods);
    if (on * off > 0 &&
        std::min(std::abs(on), std::abs(off)) >= kAgree * std::max(std::abs(on), std::abs(off)))
      return true;
  }
  return false;
}

// Taken for one with fewer turns than it has, a coil's linkages move by less than they should:
// c = (share/turns)^2 - 1.
double CommissionedDetector::MoreTurns(int coil, double excess) const {
  if (share_[coil] >= 1 || excess >= 0 || excess < -kMostRegained || !PhasesAgree(coil)) return 0;
  const double turns = share_[coil] / std::sqrt(1 + excess);
  return turns > kMoreThanAll ? 0 : turns > kAsGoodAsAll ? 1 : turns;
}

bool CommissionedDetector::CurrentIsFalse(int coil) const {
  return false_current_[coil] >= kMissedTwice;
}

bool CommissionedDetector::HasNoCurrent(int coil) const { return dead_[coil] >= kInARow; }

std::vector<Diagnosis> CommissionedDetector::CoilsWithoutCurrent(double t) const {
  std::vector<Diagnosis> out;
  for (int j = 0; j < filter_.nominal().coils; ++j) {
    if (!HasNoCurrent(j)) continue;
    out.push_back(Classify(j, RecentExcess(j), t));
    out.back().cls = FaultClass::kOpen;
    out.back().onset = dead_since_[j];
  }
  return out;
}

CommissionedDetector::Outcome CommissionedDetector::WithoutCurrent(double t) const {
  Outcome out;
  const std::vector<Diagnosis> failed = CoilsWithoutCurrent(t);
  if (failed.empty() || MayBounce()) return out;
  out.alarm = out.decided = true;
  out.excess = now_[failed[0].coil];
  out.Blame(failed);
  return out;
}

bool CommissionedDetector::LessThanATurn(int coil, double excess) const {
  const LinkageModel& m = filter_.nominal();
  const double turns = std::abs(m.n[coil]);
  return turns >= kCountedTurns && excess > 0 &&
         excess * turns < kLeastTurns * ExcessOfLoss(m, coil).own;
}

double CommissionedDetector::LeastLost(int coil, double per_excess) const {
  // No phase that starts at zero current was learnt from either.
  const double c = excess_.gross[coil] > 0 ? kGrossAbove : out_of_range_ ? gross_above_[coil] : 0;
  const double gross = c > 0 ? 1 - 1 / std::sqrt(1 + c) : kLeastLost;
  const Lane& healthy = model_.largest[kWindowOfJoint];
  const double error = *std::max_element(healthy.v, healthy.v + filter_.nominal().coils);
  return std::max(gross, kBandOverHealthy * error * per_excess);
}

bool CommissionedDetector::JudgedTogether(const MeasuredPeriod& in, Outcome* out) const {
  if (!Relies() || !(LargestNow() > kGross)) return false;
  const int coils = filter_.nominal().coils;
  std::vector<Diagnosis> failed = CoilsWithoutCurrent(in.t);
  Lane dead;
  bool others = false;
  for (int j = 0; j < coils; ++j) {
    dead[j] = share_[j] > 0 && period_.largest[j] < kConducts ? 1 : 0;
    others = others || (dead[j] == 0 && std::abs(now_[j]) > kGross);
  }
  if (others) {
    const auto shares = joint_.Solve(filter_, model_.coils, settings_, share_, dead);
    if (!shares) return false;
    for (int j = 0; j < coils; ++j) {
      const double left = shares->left[j] / share_[j];
      if (share_[j] > 0 && dead[j] == 0 && 1 - left > LeastLost(j, shares->per_excess[j]))
        failed.push_back(Classify(j, 1 / (left * left) - 1, in.t));
    }
  }
  if (failed.empty()) return false;
  const double left = 1 - failed[0].fraction;
  out->excess = failed[0].cls == FaultClass::kPartialShort ? 1 / (left * left) - 1
                                                           : RecentExcess(failed[0].coil);
  // One coil that lost turns needs its second witness.
  out->decided = failed.size() > 1 || Decided(failed[0].coil, out->excess);
  out->Blame(failed);
  return true;
}

bool CommissionedDetector::ShortedAgain(const Diagnosis& d) const {
  if (d.cls != FaultClass::kPartialShort) return false;
  for (int j = 0; j < filter_.nominal().coils; ++j)
    if (SharesCore(j, d.coil) && share_[j] > 0 && share_[j] < 1 &&
        count_ - share_taken_[j] < kOnOneCore)
      return true;
  return false;
}

bool CommissionedDetector::AwaitsCompanion(const Diagnosis& d, double excess) const {
  if (d.cls != FaultClass::kPartialShort || excess < 0 || excess > kGross || waited_ >= kMostWaited)
    return false;
  for (int j = 0; j < filter_.nominal().coils; ++j) {
    if (j == d.coil || share_[j] == 0 || SharesCore(j, d.coil) ||
        streak_[j] >= static_cast<int>(kInARow))
      continue;
    if (ratio_[j] > kAboutToStandOut && RecentExcess(j) > kCompanion * excess) return true;
  }
  return false;
}

std::vector<Diagnosis> CommissionedDetector::Companions(int decided, double excess,
                                                        double time) const {
  std::vector<Diagnosis> out;
  for (int j = 0; j < filter_.nominal().coils; ++j) {
    if (j == decided || share_[j] == 0 || streak_[j] < static_cast<int>(kInARow)) continue;
    // Turns lost by one winding of a thrust side raise the c of both: one flux links them.
    if (excess > 0 && SharesCore(j, decided)) continue;
    const double c = RecentExcess(j);
    if (c * excess > 0 && std::abs(c) > kCompanion * std::abs(excess) && Decided(j, c))
      out.push_back(Classify(j, c, time));
  }
  return out;
}

double CommissionedDetector::RecentExcess(int coil) const {
  double top = 0, bottom = 0;
  for (const Recent& period : recent_) {
    top += period.top[coil];
    bottom += period.bottom[coil];
  }
  return bottom > 0.5 ? top / bottom : 0;
}

Diagnosis CommissionedDetector::Classify(int coil, double excess, double time) const {
  Diagnosis d;
  d.coil = coil;
  d.time = time + sampling_.samples * sampling_.step;
  d.onset = onset_[coil];
  d.confidence = 1;
  const double on = windows_.OfPhase(coil, 0, 3), off = windows_.OfPhase(coil, 1, 3);
  if (period_.largest[coil] < kConducts) {
    d.cls = FaultClass::kOpen;
  } else if (on < kReversed && std::abs(off) < kGross) {
    d.cls = FaultClass::kAmplifierOff;
  } else if (off < kReversed && std::abs(on) < kGross) {
    d.cls = FaultClass::kSwitchStuckOn;
  } else if (excess > 0) {
    d.cls = FaultClass::kPartialShort;
    d.fraction = 1 - 1 / std::sqrt(1 + excess);
  } else if (share_[coil] < 1 && excess > -kMostRegained && !CurrentIsFalse(coil)) {
    // A loop that closes through its own resistance was taken for more turns than it has: of the turns believed to
    // work, a negative part is shorted.
    d.cls = FaultClass::kPartialShort;
    d.fraction = 1 - std::min(1 / share_[coil], 1 / std::sqrt(1 + excess));
  } else {
    d.cls = FaultClass::kCurrentSensor;
  }
  return d;
}

}  // namespace ambrig
