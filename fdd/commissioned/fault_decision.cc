#include "fdd/commissioned/fault_decision.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

constexpr double kMoreThanAll = 1.07, kAsGoodAsAll = 0.95;  // of the turns
constexpr double kLeastLost = 0.1;        // of the turns, for coils that fail at once
constexpr long long kOnOneCore = 2500;    // periods after turns were lost on one core: more of them
constexpr double kAlikeExcess = 0.5;      // of the largest c, of a model that is not the machine's
constexpr long long kMismatched = 2500;   // periods after which the turns are judged again
constexpr int kMostWaited = 10;           // periods, for another coil
constexpr double kAboutToStandOut = 0.5;  // of its band
constexpr int kWindowOfJoint = 1;  // of three periods: what healthy running leaves in as many

double FractionOf(double excess) { return 1 - 1 / std::sqrt(1 + excess); }

/// Share of the turns that a coil must have lost to be one of several that failed; `per_excess` of
/// JointShares.
double LeastLost(const CoilEvidence& seen, int coil, double per_excess) {
  // No phase that starts at zero current was learnt from either.
  const double c = seen.sums.gross[coil] > 0 ? ExcessLimits::kGrossAbove
                   : seen.range.left()       ? seen.GrossAbove(coil)
                                             : 0;
  const double gross = c > 0 ? FractionOf(c) : kLeastLost;
  const Lane& healthy = seen.learnt.largest[kWindowOfJoint];
  const double error = *std::max_element(healthy.v, healthy.v + seen.coils());
  return std::max(gross, kBandOverHealthy * error * per_excess);
}

}  // namespace

CoilVerdict FaultDecision::Judge(const CoilEvidence& seen) {
  CoilVerdict out;
  out.doubtful = seen.Doubtful();
  const Lane& ratio = seen.ratios.ratio();
  const int coil = static_cast<int>(std::max_element(ratio.v, ratio.v + seen.coils()) - ratio.v);
  out.alarm = ratio[coil] > 1;
  if (!out.alarm) waited_ = 0;
  CountStreaks(seen);
  if (!out.alarm || !InARow(coil)) return out;
  if (seen.count < mismatch_until_) return InMismatch(seen, out);
  out.excess = seen.ratios.Recent(coil);
  if (!JudgedTogether(seen, &out)) {
    if (!seen.ratios.RecentAgrees(coil)) return out;
    out.turns = MoreTurns(seen, coil, out.excess);
    out.decided = out.turns > 0 || seen.Suffices(coil, out.excess);
    if (!out.decided) return out;
    out.diagnosis = seen.Classify(coil, out.excess, onset_[coil]);
    if (out.turns == 0) {
      if (AwaitsCompanion(seen, out.diagnosis, out.excess)) {
        ++waited_;
        out.decided = false;
        return out;
      }
      out.more = Companions(seen, coil, out.excess);
    }
  }
  if (out.decided && out.turns == 0 && IsMismatch(seen, out)) {
    mismatch_until_ = seen.count + kMismatched;
    return InMismatch(seen, out);
  }
  if (out.decided && out.turns == 0 && ShortedAgain(seen, out.diagnosis)) {
    out.decided = false;
    out.doubtful = true;
  }
  return out;
}

CoilVerdict FaultDecision::WithoutCurrent(const CoilEvidence& seen) const {
  CoilVerdict out;
  const std::vector<Diagnosis> failed = CoilsWithoutCurrent(seen);
  if (failed.empty() || seen.MayBounce()) return out;
  out.alarm = out.decided = true;
  out.excess = seen.ratios.now()[failed[0].coil];
  out.Blame(failed);
  return out;
}

void FaultDecision::CountStreaks(const CoilEvidence& seen) {
  const Lane& ratio = seen.ratios.ratio();
  const double least = ExcessLimits::kCompanion * *std::max_element(ratio.v, ratio.v + kLanes);
  for (int j = 0; j < seen.coils(); ++j) {
    if (!(ratio[j] > 1) || ratio[j] < least) {
      streak_[j] = 0;
      continue;
    }
    if (streak_[j] == 0) onset_[j] = seen.in.t;
    ++streak_[j];
  }
}

double FaultDecision::MoreTurns(const CoilEvidence& seen, int coil, double excess) const {
  // Taken for one with fewer turns than it has, a coil's linkages move by less than they should:
  // c = (share/turns)^2 - 1.
  if (seen.share(coil) >= 1 || excess >= 0 || excess < -ExcessLimits::kMostRegained ||
      !seen.PhasesAgree(coil))
    return 0;
  const double turns = seen.share(coil) / std::sqrt(1 + excess);
  return turns > kMoreThanAll ? 0 : turns > kAsGoodAsAll ? 1 : turns;
}

std::vector<Diagnosis> FaultDecision::CoilsWithoutCurrent(const CoilEvidence& seen) const {
  std::vector<Diagnosis> out;
  for (int j = 0; j < seen.coils(); ++j) {
    if (!seen.currents.IsMissing(j)) continue;
    out.push_back(seen.Classify(j, seen.ratios.Recent(j), seen.currents.missing_since(j)));
    out.back().cls = FaultClass::kOpen;
  }
  return out;
}

bool FaultDecision::JudgedTogether(const CoilEvidence& seen, CoilVerdict* out) const {
  if (!seen.Relies() || !(seen.ratios.LargestNow() > ExcessLimits::kGross)) return false;
  std::vector<Diagnosis> failed = CoilsWithoutCurrent(seen);
  Lane dead;
  bool others = false;
  for (int j = 0; j < seen.coils(); ++j) {
    dead[j] = seen.share(j) > 0 && seen.flux.largest[j] < kConducts ? 1 : 0;
    others = others || (dead[j] == 0 && std::abs(seen.ratios.now()[j]) > ExcessLimits::kGross);
  }
  if (others) {
    const auto shares =
        joint_.Solve(seen.filter, seen.learnt.coils, seen.settings, seen.turns.share, dead);
    if (!shares) return false;
    for (int j = 0; j < seen.coils(); ++j) {
      const double left = shares->left[j] / seen.share(j);
      if (seen.share(j) > 0 && dead[j] == 0 && 1 - left > LeastLost(seen, j, shares->per_excess[j]))
        failed.push_back(seen.Classify(j, 1 / (left * left) - 1, onset_[j]));
    }
  }
  if (failed.empty()) return false;
  const double left = 1 - failed[0].fraction;
  out->excess = failed[0].cls == FaultClass::kPartialShort ? 1 / (left * left) - 1
                                                           : seen.ratios.Recent(failed[0].coil);
  // One coil that lost turns needs its second indication.
  out->decided = failed.size() > 1 || seen.Suffices(failed[0].coil, out->excess);
  out->Blame(failed);
  return true;
}

bool FaultDecision::IsMismatch(const CoilEvidence& seen, const CoilVerdict& out) const {
  int shorted = 0;
  const auto at_once = [&](const Diagnosis& d) {
    shorted += d.cls == FaultClass::kPartialShort;
    return d.cls == FaultClass::kPartialShort && seen.ratios.Sudden(d.coil);
  };
  if (at_once(out.diagnosis) || std::ranges::any_of(out.more, at_once) || shorted == 0)
    return false;
  if (shorted > 1 && std::abs(out.excess) > ExcessLimits::kGross) return true;
  const Lane &n = seen.nominal().n, &c = seen.ratios.now();
  // A coil that failed stands out from what it makes of its neighbours.
  const double alike =
      std::max(ExcessLimits::kGross, kAlikeExcess * *std::max_element(c.v, c.v + seen.coils()));
  int coils = 0;
  bool positive = false, negative = false;
  for (int j = 0; j < seen.coils(); ++j) {
    if (seen.share(j) == 0 || c[j] < alike) continue;
    ++coils;
    (n[j] > 0 ? positive : negative) = true;
  }
  return coils >= ExcessLimits::kCoilsAtOnce && positive && negative;
}

CoilVerdict FaultDecision::InMismatch(const CoilEvidence& seen, CoilVerdict out) const {
  CoilVerdict left = WithoutCurrent(seen);
  if (left.decided) return left;
  out.decided = false;
  out.doubtful = true;
  return out;
}

bool FaultDecision::ShortedAgain(const CoilEvidence& seen, const Diagnosis& d) const {
  if (d.cls != FaultClass::kPartialShort) return false;
  for (int j = 0; j < seen.coils(); ++j)
    if (SharesCore(seen.nominal(), j, d.coil) && seen.share(j) > 0 && seen.share(j) < 1 &&
        seen.count - seen.turns.taken[j] < kOnOneCore)
      return true;
  return false;
}

bool FaultDecision::AwaitsCompanion(const CoilEvidence& seen, const Diagnosis& d,
                                    double excess) const {
  if (d.cls != FaultClass::kPartialShort || excess < 0 || excess > ExcessLimits::kGross ||
      waited_ >= kMostWaited)
    return false;
  for (int j = 0; j < seen.coils(); ++j) {
    if (j == d.coil || seen.share(j) == 0 || SharesCore(seen.nominal(), j, d.coil) || InARow(j))
      continue;
    if (seen.ratios.ratio()[j] > kAboutToStandOut &&
        seen.ratios.Recent(j) > ExcessLimits::kCompanion * excess)
      return true;
  }
  return false;
}

std::vector<Diagnosis> FaultDecision::Companions(const CoilEvidence& seen, int decided,
                                                 double excess) const {
  std::vector<Diagnosis> out;
  for (int j = 0; j < seen.coils(); ++j) {
    if (j == decided || seen.share(j) == 0 || !InARow(j)) continue;
    // Turns lost by one winding of a thrust side raise the c of both: one flux links them.
    if (excess > 0 && SharesCore(seen.nominal(), j, decided)) continue;
    const double c = seen.ratios.Recent(j);
    if (c * excess > 0 && std::abs(c) > ExcessLimits::kCompanion * std::abs(excess) &&
        seen.Suffices(j, c))
      out.push_back(seen.Classify(j, c, onset_[j]));
  }
  return out;
}

}  // namespace ambrig
