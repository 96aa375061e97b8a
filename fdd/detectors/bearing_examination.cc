#include <algorithm>
#include <cmath>

#include "fdd/detectors/bearing_detector.h"
#include "fdd/examination/coil_examination.h"
#include "fdd/examination/shorted_coils.h"

// BearingDetector after an alarm: whom it suspects, what it finds, what it knows from then on.

namespace ambrig {

namespace {
constexpr int kTogether[] = {2, 5};    // periods that tell several shorted coils, or else
constexpr double kGrossResidual = 6;   // [sd] residual that no noise makes
constexpr double kPartnerMargin = 12;  // between two windings on one core: e^-6

/// Winding with the share `left` of its turns, the others bypassed.
void ShortTurns(LinkageModel& m, int j, double left) {
  m.n[j] *= left;
  m.leakage[j] *= left * left;
  m.resistance[j] *= left;
}

}  // namespace

LinkageModel BearingDetector::LearnedModel() const {
  LinkageModel m = model_;
  const ModelError& known = learning_.known();
  for (int j = 0; j < m.coils; ++j) m.leakage[j] += known.leakage;
  m.reluctance.per_metre /= 1 - known.gap;
  m.reluctance.offset /= 1 - known.gap;
  return m;
}

int BearingDetector::Largest() const {
  int worst = 0;
  double most = -1;
  for (int j = 0; j < model_.coils; ++j) {
    double size = 0;
    for (int q = 0; q < 2; ++q)
      if (Holds(q, j)) size += std::abs(chart_.e[q][j]);
    if (chart_.G[0][j] + chart_.G[1][j] + chart_.G[2][j] > 0 && size > most) {
      most = size;
      worst = j;
    }
  }
  return worst;
}

int BearingDetector::Suspect(const std::vector<const KeptPeriod*>& periods, bool* clear) const {
  // Of two windings on one core the fault of one shows in both: only their examination tells.
  *clear = model_.coupling == Coupling::kNone;
  if (model_.coupling != Coupling::kFloatingRotor) return Largest();
  const LinkageModel m = LearnedModel();
  int best = Largest();
  double least = 1e30, next = 1e30;
  for (int j = 0; j < m.coils; ++j) {
    if (state_[static_cast<std::size_t>(j)] == Coil::kLost ||
        unknown_mmf_[static_cast<std::size_t>(j)])
      continue;
    std::array<bool, kLanes> excluded = unknown_mmf_;
    excluded[static_cast<std::size_t>(j)] = true;
    double cost = 0;
    for (const KeptPeriod* p : periods) {
      if (!p->in.comparable) continue;
      PeriodSlopes now;
      ComputePeriodSlopesUnknownMmf(m, s_.sampling, p->in, excluded, &now);
      for (int q = 0; q < 2; ++q)
        for (int k = 0; k < m.coils; ++k) {
          const auto lane = static_cast<std::size_t>(k);
          if (excluded[lane] || state_[lane] == Coil::kLost ||
              now.phase[q].samples[k] < kFewestSamples)
            continue;
          const PhaseSlopes& a = now.phase[q];
          const double e = a.residual[k];
          if (a.least[k] < kZeroCurrent && (q == 1 || (a.mean[k] < 2 * kZeroCurrent && e > 0)))
            continue;
          cost += std::min(e * e, 900.0);  // [V²]
        }
    }
    next = std::min(next, std::max(cost, least));
    if (cost < least) {
      least = cost;
      best = j;
    }
  }
  *clear = next > 2 * least + 20;  // [V²]: above the noise of two periods
  return best;
}

std::vector<const KeptPeriod*> BearingDetector::LastPeriods(long long n) const {
  std::vector<const KeptPeriod*> out;
  for (long long k = std::max(0LL, count_ - n); k < count_; ++k)
    out.push_back(&ring_[static_cast<std::size_t>(k % kRing)]);
  return out;
}

std::vector<Diagnosis> BearingDetector::ExamineTogether() {
  std::vector<Diagnosis> out;
  if (model_.coupling != Coupling::kFloatingRotor || any_unknown_) return out;
  std::array<bool, kLanes> judged{};
  for (int j = 0; j < model_.coils; ++j) judged[static_cast<std::size_t>(j)] = watched_[j] > 0;
  ShortedCoils found;
  for (int periods : kTogether)
    if (found.coils.empty() && count_ - alarm_at_ >= periods)
      found = FindShortedCoils(LearnedModel(), s_, LastPeriods(periods), judged);
  for (int j : found.coils) {
    Diagnosis d;
    d.coil = j;
    d.cls = FaultClass::kPartialShort;
    d.fraction = 1 - found.turns_left[j];
    d.time = LastPeriods(1).back()->in.t + s_.sampling.step * s_.sampling.samples;
    d.onset = ring_[static_cast<std::size_t>((alarm_at_ - 1) % kRing)].in.t;
    d.confidence = found.confidence;
    Accept(d, false);
    out.insert(j == suspect_ ? out.begin() : out.end(), d);
  }
  return out;
}

Diagnosis BearingDetector::Examine() {
  const std::vector<const KeptPeriod*> periods = LastPeriods(kRing);
  if (model_.coupling == Coupling::kFloatingRotor) {
    const int now = Suspect(LastPeriods(count_ - alarm_at_ + 2), &suspect_clear_);
    if (suspect_clear_ || !raised_) suspect_ = now;
  }
  const bool last = count_ - alarm_at_ >= kLongestExamination;
  const LinkageModel model = LearnedModel();
  const long long suspicious =
      std::min<long long>(count_ - calm_at_, static_cast<long long>(periods.size()));
  const std::size_t calm = periods.size() - static_cast<std::size_t>(suspicious);
  Examination x = ExamineCoil(model, s_, periods, calm, suspect_, last);
  if (model_.coupling == Coupling::kSides &&
      state_[static_cast<std::size_t>(suspect_ ^ 1)] == Coil::kHealthy) {
    const Examination partner = ExamineCoil(model, s_, periods, calm, suspect_ ^ 1, last);
    const bool named = x.diagnosis.cls != FaultClass::kNone,
               other = partner.diagnosis.cls != FaultClass::kNone;
    suspect_clear_ = (named != other && std::max(x.cost, partner.cost) < 1e30) ||
                     std::abs(partner.cost - x.cost) > kPartnerMargin;
    if (other && (!named || partner.cost < x.cost)) {
      x = partner;
      suspect_ ^= 1;
    }
    if (!suspect_clear_ && !last) return {};
  }
  if (!x.decided || x.diagnosis.cls == FaultClass::kNone) return {};
  // What the flux of the others told is worth nothing when another coil fails meanwhile: wait.
  if (!last && !OthersHold(model, x.diagnosis, x.closed_loop)) return {};
  Diagnosis d = x.diagnosis;
  d.time = periods.back()->in.t + s_.sampling.step * s_.sampling.samples;
  Accept(d, x.closed_loop);
  return d;
}

bool BearingDetector::OthersHold(const LinkageModel& learned, const Diagnosis& d,
                                 bool closed_loop) const {
  const bool shorted = d.cls == FaultClass::kPartialShort;
  if (model_.coupling != Coupling::kFloatingRotor ||
      (!shorted && d.cls != FaultClass::kCurrentSensor))
    return true;
  LinkageModel m = learned;
  std::array<bool, kLanes> unknown = unknown_mmf_;
  if (shorted) ShortTurns(m, d.coil, 1 - d.fraction);
  unknown[static_cast<std::size_t>(d.coil)] = !shorted || closed_loop;
  const bool any = std::any_of(unknown.begin(), unknown.end(), [](bool b) { return b; });
  for (const KeptPeriod* p : LastPeriods(2)) {
    if (!p->in.comparable) continue;
    PeriodSlopes now;
    if (any)
      ComputePeriodSlopesUnknownMmf(m, s_.sampling, p->in, unknown, &now);
    else
      ComputePeriodSlopes(m, s_.sampling, p->in, &now);
    for (int q = 0; q < 2; ++q)
      for (int j = 0; j < m.coils; ++j)
        if (j != d.coil && Holds(q, j) && now.phase[q].least[j] > kZeroCurrent &&
            now.phase[q].samples[j] >= kFewestSamples &&
            std::abs(now.phase[q].residual[j]) > kGrossResidual * chart_.sd[q][j])
          return false;
  }
  return true;
}

void BearingDetector::Accept(const Diagnosis& d, bool closed_loop) {
  const auto lane = static_cast<std::size_t>(d.coil);
  const int j = d.coil;
  switch (d.cls) {
    case FaultClass::kPartialShort: {
      ShortTurns(model_, j, 1 - d.fraction);
      state_[lane] = closed_loop ? Coil::kUnknownMmf : Coil::kShort;
      unknown_mmf_[lane] = closed_loop;
      // the fraction is an estimate: wider until learned
      chart_.size[0][j] = chart_.size[1][j] = 2.4;
      break;
    }
    case FaultClass::kCurrentSensor:
      state_[lane] = Coil::kUnknownMmf;
      unknown_mmf_[lane] = false_reading_[lane] = any_false_reading_ = true;
      break;
    case FaultClass::kSwitchStuckOn:  // its ADC will clip
      state_[lane] = Coil::kUnknownMmf;
      unknown_mmf_[lane] = true;
      break;
    default:
      state_[lane] = Coil::kLost;
      break;
  }
  watched_[j] = state_[lane] == Coil::kShort ? 1 : 0;
  any_unknown_ = std::any_of(unknown_mmf_.begin(), unknown_mmf_.end(), [](bool b) { return b; });
  if (model_.coupling == Coupling::kSides && unknown_mmf_[lane]) {
    state_[lane ^ 1] = Coil::kUnknownMmf;  // one core: nothing else tells its partner's flux
    watched_[j ^ 1] = 0;
  }
  paused_ = 2;
}

}  // namespace ambrig
