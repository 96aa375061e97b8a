#include "fdd/bearing_detector.h"

#include <algorithm>
#include <cmath>

#include "fdd/coil_examination.h"

namespace ambrig {

namespace {
constexpr int kRing = 20;             // periods kept
constexpr double kFewest = 4;         // samples of a phase that counts
constexpr double kZeroCurrent = 0.03; // [A] below: the diodes may block
constexpr double kClosestGap = 0.4;      // of the nominal: nearer, its error rules the inductance
constexpr int kLongestExamination = 12;
constexpr double kPartnerMargin = 12;    // between two windings on one core: e^-6
constexpr double kDoubt = 3;           // tolerances count this many times
constexpr double kLeastUnknownCurrent = 1;  // [A] what a coil of unknown MMF may carry beside its reading
constexpr double kLeastLeakage = 0.2, kLeastGap = 0.3;  // of the tolerances: coils differ within a bearing
constexpr int kLearnEvery = 4;         // periods
constexpr double kForget = kLearnEvery / 500.0, kSizeRate = kLearnEvery / 200.0;
}  // namespace

BearingDetector::BearingDetector(const LinkageModel& model, const DetectorSettings& settings)
    : model_(model), s_(settings), ring_(kRing) {
  for (std::size_t n = 0; n < slope_variance_.size(); ++n)
    slope_variance_[n] = SlopeVariance(static_cast<double>(n), s_.sampling.step);
  for (Lane& size : size_)
    for (int j = 0; j < kLanes; ++j) size[j] = 0.8;  // mean of |z| of a normal variable
  const Lane P = model_.Permeance(0, 0);
  centred_ = *std::max_element(P.v, P.v + kLanes);
  Solve();
}

void BearingDetector::Solve() {
  const double leak = 1 / (s_.leakage_sd * s_.leakage_sd), gap = 1 / (s_.gap_sd * s_.gap_sd);
  const double p0 = info_[0] + leak, p1 = info_[2] + gap;
  const double det = p0 * p1 - info_[1] * info_[1];
  theta_[0] = std::clamp((p1 * pull_[0] - info_[1] * pull_[1]) / det, -5 * s_.leakage_sd, 5 * s_.leakage_sd);
  theta_[1] = std::clamp((p0 * pull_[1] - info_[1] * pull_[0]) / det, -5 * s_.gap_sd, 5 * s_.gap_sd);
  // Covariance of what is left; in e the regressors are -di and flux.
  doubt_[0] = kDoubt * kDoubt * p1 / det + kLeastLeakage * kLeastLeakage / leak;
  doubt_[1] = -2 * kDoubt * kDoubt * info_[1] / det;
  doubt_[2] = kDoubt * kDoubt * p0 / det + kLeastGap * kLeastGap / gap;
}

void BearingDetector::Keep(const MeasuredPeriod& in) {
  KeptPeriod& kept = ring_[static_cast<std::size_t>(count_ % kRing)];
  kept.in = in;
  std::copy(in.adc, in.adc + s_.sampling.samples, kept.adc.begin());
  kept.duty = *in.duty;
  kept.in.adc = kept.adc.data();
  kept.in.duty = &kept.duty;
  ++count_;
}

double BearingDetector::UnknownPotential() const {
  double doubt = 0;
  for (int k = 0; any_unknown_ && k < model_.coils; ++k)
    if (unknown_mmf_[static_cast<std::size_t>(k)])
      doubt += std::abs(model_.n[k]) * slopes_.P[k] * std::max(slopes_.largest[k], kLeastUnknownCurrent);
  return doubt / slopes_.total;
}

void BearingDetector::Residuals(const MeasuredPeriod& in) {
  if (any_unknown_ && model_.coupling == Coupling::kFloatingRotor)
    ComputePeriodSlopesUnknownMmf(model_, s_.sampling, in, unknown_mmf_, &slopes_);
  else
    ComputePeriodSlopes(model_, s_.sampling, in, &slopes_);
  const bool radial = model_.coupling == Coupling::kFloatingRotor;
  // What an unknown MMF was at the first sample stays unknown: the motion turns it into a voltage.
  const double potential_rate = UnknownPotential() / (s_.sampling.step * s_.sampling.samples);
  for (int q = 0; q < 2; ++q) {
    const PhaseSlopes& p = slopes_.phase[q];
    for (int j = 0; j < model_.coils; ++j) {
      const auto lane = static_cast<std::size_t>(j);
      const double moved = model_.n[j] * slopes_.dP[j] * potential_rate;
      const double flux = p.linkage[j] - model_.leakage[j] * p.current[j];
      const double own = model_.SelfInductance(j, slopes_.P, radial ? slopes_.total : 1);
      const double noise = own * s_.current_noise;
      const double di = p.current[j];
      const double variance = noise * noise * slope_variance_[static_cast<std::size_t>(p.samples[j])] +
                              doubt_[0] * di * di - doubt_[1] * di * flux + doubt_[2] * flux * flux +
                              s_.voltage_sd * s_.voltage_sd + moved * moved;
      e_[q][j] = p.residual[j] + theta_[0] * p.current[j] - theta_[1] * flux;
      sd_[q][j] = std::sqrt(variance) * std::clamp(size_[q][j] / 0.8, 1.0, 5.0);
      z_[q][j] = e_[q][j] / sd_[q][j];
      bool ok = p.samples[j] >= kFewest && slopes_.largest[j] < s_.adc_limit &&
                (state_[lane] == Coil::kHealthy || state_[lane] == Coil::kShort);
      // At zero current the diodes may block: off says nothing, on only that too little flux comes.
      if (p.least[j] < kZeroCurrent && (q == 1 || (p.mean[j] < 2 * kZeroCurrent && e_[q][j] > 0))) ok = false;
      valid_[q][lane] = ok;
      if (!ok) z_[q][j] = 0;
    }
  }
}

int BearingDetector::StepBetweenPeriods(const Lane& last_linkage, const Lane& last_voltage, const MeasuredPeriod& in) {
  const double h = s_.sampling.step;
  const bool radial = model_.coupling == Coupling::kFloatingRotor;
  int largest = -1;
  double most = s_.cap;
  for (int j = 0; j < model_.coils; ++j) {
    const auto lane = static_cast<std::size_t>(j);
    const double step = std::abs((slopes_.first[j] - last_linkage[j]) / h - last_voltage[j]);
    if (step < s_.cap || (!valid_[0][lane] && !valid_[1][lane]) || in.adc[0][j] < kZeroCurrent) continue;
    const double own = model_.SelfInductance(j, slopes_.P, radial ? slopes_.total : 1);
    const double sd = 1.4 * own * s_.current_noise / h + 1;
    if (step < most * sd) continue;
    most = step / sd;
    largest = j;
  }
  if (largest >= 0) G_[0][largest] += 2 * s_.threshold;
  return largest;
}

void BearingDetector::Cusum() {
  for (int j = 0; j < model_.coils; ++j) {
    const auto lane = static_cast<std::size_t>(j);
    const double both = valid_[0][lane] && valid_[1][lane] ? (z_[0][j] - z_[1][j]) * 0.7071 : 0;
    const double z[3] = {z_[0][j], z_[1][j], both};
    const bool counts[3] = {valid_[0][lane], valid_[1][lane], valid_[0][lane] && valid_[1][lane]};
    for (int q = 0; q < 3; ++q)
      if (counts[q]) G_[q][j] = std::max(0.0, G_[q][j] + std::min(std::abs(z[q]), s_.cap) - s_.drift);
  }
}

void BearingDetector::Learn() {
  // e = -leakage_error di + gap_error flux, normal equations with forgetting and a prior.
  double a00 = 0, a01 = 0, a11 = 0, b0 = 0, b1 = 0;
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < model_.coils; ++j) {
      if (!valid_[q][static_cast<std::size_t>(j)]) continue;
      const PhaseSlopes& p = slopes_.phase[q];
      const double size = std::min(std::abs(z_[q][j]), 4.0);
      size_[q][j] += kSizeRate * (size - size_[q][j]);
      const double w = kLearnEvery / (sd_[q][j] * sd_[q][j]);
      const double x0 = -p.current[j], x1 = p.linkage[j] - model_.leakage[j] * p.current[j];
      const double e = p.residual[j];
      a00 += w * x0 * x0;
      a01 += w * x0 * x1;
      a11 += w * x1 * x1;
      b0 += w * x0 * e;
      b1 += w * x1 * e;
    }
  info_[0] += a00 - kForget * info_[0];
  info_[1] += a01 - kForget * info_[1];
  info_[2] += a11 - kForget * info_[2];
  pull_[0] += b0 - kForget * pull_[0];
  pull_[1] += b1 - kForget * pull_[1];
  Solve();
}

LinkageModel BearingDetector::LearnedModel() const {
  LinkageModel m = model_;
  for (int j = 0; j < m.coils; ++j) m.leakage[j] += theta_[0];
  m.reluctance.per_metre /= 1 - theta_[1];
  m.reluctance.offset /= 1 - theta_[1];
  return m;
}

int BearingDetector::Largest() const {
  int worst = 0;
  double most = -1;
  for (int j = 0; j < model_.coils; ++j) {
    double size = 0;
    for (int q = 0; q < 2; ++q)
      if (valid_[q][static_cast<std::size_t>(j)]) size += std::abs(e_[q][j]);
    if (G_[0][j] + G_[1][j] + G_[2][j] > 0 && size > most) {
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
    if (state_[static_cast<std::size_t>(j)] == Coil::kLost || unknown_mmf_[static_cast<std::size_t>(j)]) continue;
    std::array<bool, kLanes> excluded = unknown_mmf_;
    excluded[static_cast<std::size_t>(j)] = true;
    double cost = 0;
    for (const KeptPeriod* p : periods) {
      PeriodSlopes now;
      ComputePeriodSlopesUnknownMmf(m, s_.sampling, p->in, excluded, &now);
      for (int q = 0; q < 2; ++q)
        for (int k = 0; k < m.coils; ++k) {
          const auto lane = static_cast<std::size_t>(k);
          if (excluded[lane] || state_[lane] == Coil::kLost || now.phase[q].samples[k] < kFewest) continue;
          const PhaseSlopes& a = now.phase[q];
          const double e = a.residual[k];
          if (a.least[k] < kZeroCurrent && (q == 1 || (a.mean[k] < 2 * kZeroCurrent && e > 0))) continue;
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

BearingDetector::Alarm BearingDetector::Period(const MeasuredPeriod& in) {
  Alarm out;
  Keep(in);
  const Lane last_linkage = slopes_.last;
  Lane last_voltage;  // mean between the last sample and the end of the period
  for (int j = 0; j < model_.coils; ++j) {
    const double h = s_.sampling.step;
    const double on = std::clamp(slopes_.edge[j] - (s_.sampling.samples - 1) * h, 0.0, h) / h;
    last_voltage[j] = on * slopes_.phase[0].voltage[j] + (1 - on) * slopes_.phase[1].voltage[j];
  }
  Residuals(in);
  const bool follows = follows_;
  bool comparable = in.comparable;
  for (double P : slopes_.P.v) comparable = comparable && P * kClosestGap < centred_;
  follows_ = comparable && !any_unknown_;
  if (paused_ > 0) {
    --paused_;
    return out;
  }
  if (alarm_at_ < 0) {
    if (comparable) Cusum();
    int stepped = -1;
    if (comparable && follows && !any_unknown_) stepped = StepBetweenPeriods(last_linkage, last_voltage, in);
    bool alarm = false, calm = comparable;
    for (int q = 0; q < 3; ++q)
      for (int j = 0; j < model_.coils; ++j) {
        alarm = alarm || G_[q][j] > s_.threshold;
        calm = calm && G_[q][j] < 1.5;
      }
    if (calm) calm_at_ = count_;
    if (calm && count_ % kLearnEvery == 0) Learn();
    if (!alarm) return out;
    alarm_at_ = count_;
    bool clear = false;
    suspect_ = Suspect(LastPeriods(2), &clear);
    if (stepped >= 0 && !clear) {
      suspect_ = stepped;
      clear = true;
    }
    raised_ = out.raised = clear;
    out.coil = clear ? suspect_ : -1;
    return out;
  }
  const Diagnosis d = Examine();
  // A fault late in a period shows its coil only in the next one.
  const int patience = model_.coupling == Coupling::kSides ? 4 : 2;
  if (!raised_ && (suspect_clear_ || d.cls != FaultClass::kNone || count_ - alarm_at_ >= patience))
    raised_ = out.raised = true;
  out.coil = raised_ ? suspect_ : -1;
  const bool given_up = count_ - alarm_at_ >= kLongestExamination;
  if (d.cls != FaultClass::kNone) {
    out.diagnosis = d;
  } else if (given_up) {
    out.cleared = true;
  } else {
    return out;
  }
  alarm_at_ = -1;
  for (Lane& G : G_) G = Lane{};
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
  const long long suspicious = std::min<long long>(count_ - calm_at_, static_cast<long long>(periods.size()));
  const std::size_t calm = periods.size() - static_cast<std::size_t>(suspicious);
  Examination x = ExamineCoil(model, s_, periods, calm, suspect_, last);
  if (model_.coupling == Coupling::kSides && state_[static_cast<std::size_t>(suspect_ ^ 1)] == Coil::kHealthy) {
    const Examination partner = ExamineCoil(model, s_, periods, calm, suspect_ ^ 1, last);
    const bool named = x.diagnosis.cls != FaultClass::kNone, other = partner.diagnosis.cls != FaultClass::kNone;
    suspect_clear_ = (named != other && std::max(x.cost, partner.cost) < 1e30) || std::abs(partner.cost - x.cost) > kPartnerMargin;
    if (other && (!named || partner.cost < x.cost)) {
      x = partner;
      suspect_ ^= 1;
    }
    if (!suspect_clear_ && !last) return {};
  }
  if (!x.decided || x.diagnosis.cls == FaultClass::kNone) return {};
  Diagnosis d = x.diagnosis;
  d.time = periods.back()->in.t + s_.sampling.step * s_.sampling.samples;
  Accept(d, x.closed_loop);
  return d;
}

void BearingDetector::Accept(const Diagnosis& d, bool closed_loop) {
  const auto lane = static_cast<std::size_t>(d.coil);
  const int j = d.coil;
  switch (d.cls) {
    case FaultClass::kPartialShort: {
      const double a = 1 - d.fraction;
      model_.n[j] *= a;
      model_.leakage[j] *= a * a;
      model_.resistance[j] *= a;
      state_[lane] = closed_loop ? Coil::kUnknownMmf : Coil::kShort;
      unknown_mmf_[lane] = closed_loop;
      size_[0][j] = size_[1][j] = 2.4;  // the fraction is an estimate: wider until learned
      break;
    }
    case FaultClass::kCurrentSensor:
      state_[lane] = Coil::kUnknownMmf;
      unknown_mmf_[lane] = true;
      break;
    case FaultClass::kSwitchStuckOn:  // its ADC will clip
      state_[lane] = Coil::kUnknownMmf;
      unknown_mmf_[lane] = true;
      break;
    default: state_[lane] = Coil::kLost; break;
  }
  any_unknown_ = std::any_of(unknown_mmf_.begin(), unknown_mmf_.end(), [](bool b) { return b; });
  if (model_.coupling == Coupling::kSides && unknown_mmf_[lane])
    state_[lane ^ 1] = Coil::kUnknownMmf;  // one core: nothing else tells its partner's flux
  paused_ = 2;
}

void BearingDetector::Band(int coil, double* slope, double* expected, double* half_width) const {
  const bool radial = model_.coupling == Coupling::kFloatingRotor;
  const double own = model_.SelfInductance(coil, slopes_.P, radial ? slopes_.total : 1);
  *slope = slopes_.phase[0].current[coil];
  *expected = *slope - e_[0][coil] / own;
  *half_width = 4 * sd_[0][coil] / own;
}

}  // namespace ambrig
