/// What the commissioned detector says of a coil that stands out: its witnesses, its class.
#include <algorithm>
#include <cmath>

#include "fdd/detectors/commissioned_detector.h"

namespace ambrig {

namespace {

constexpr double kAgree = 0.35;        // of the larger phase's c
constexpr double kGross = 0.5;         // |c|
constexpr double kReversed = -1.2;     // c of a phase: the bridge drives the other way
constexpr double kCompanion = 0.5;     // of the largest |c|: a fault of its own
constexpr int kMissedTwice = 2;        // periods in a row
constexpr double kMostRegained = 0.9;  // |c|
constexpr double kMoreThanAll = 1.07, kAsGoodAsAll = 0.95;  // of the turns
constexpr double kNoCurrent = 0.12;                         // [A]

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

std::vector<Diagnosis> CommissionedDetector::Companions(int decided, double excess,
                                                        double time) const {
  std::vector<Diagnosis> out;
  for (int j = 0; j < filter_.nominal().coils; ++j) {
    if (j == decided || share_[j] == 0 || streak_[j] < static_cast<int>(kInARow)) continue;
    const double c = RecentExcess(j);
    if (c * excess > 0 && std::abs(c) > kCompanion * std::abs(excess) && Decided(j, c))
      out.push_back(Classify(j, c, time));
  }
  return out;
}

double CommissionedDetector::RecentExcess(int coil) const {
  const Recent& r = recent_[static_cast<std::size_t>(coil)];
  double top = 0, bottom = 0;
  for (std::size_t k = 0; k < kInARow; ++k) {
    top += r.top[k];
    bottom += r.bottom[k];
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
  if (period_.largest[coil] < kNoCurrent) {
    d.cls = FaultClass::kOpen;
  } else if (on < kReversed && std::abs(off) < kGross) {
    d.cls = FaultClass::kAmplifierOff;
  } else if (off < kReversed && std::abs(on) < kGross) {
    d.cls = FaultClass::kSwitchStuckOn;
  } else if (excess > 0) {
    d.cls = FaultClass::kPartialShort;
    d.fraction = 1 - 1 / std::sqrt(1 + excess);
  } else if (share_[coil] < 1 && excess > -kMostRegained && !CurrentIsFalse(coil)) {
    // A loop that closes through its own resistance was taken for more turns than it has.
    d.cls = FaultClass::kPartialShort;
    d.fraction = std::max(0.0, 1 - share_[coil] / std::sqrt(1 + excess));
  } else {
    d.cls = FaultClass::kCurrentSensor;
  }
  return d;
}

}  // namespace ambrig
