#include "fdd/bearing_detector.h"

#include <algorithm>
#include <cmath>

#include "fdd/coil_examination.h"

namespace ambrig {

namespace {
constexpr int kRing = 20;             // periods kept
constexpr double kFewest = 4;         // samples of a phase that counts
constexpr double kZeroCurrent = 0.03; // [A] below: the diodes may block
constexpr int kLongestExamination = 12;
constexpr double kForget = 1.0 / 500, kSizeRate = 1.0 / 200;  // per period
}  // namespace

BearingDetector::BearingDetector(const LinkageModel& model, const DetectorSettings& settings)
    : model_(model), s_(settings), ring_(kRing) {
  for (std::size_t n = 0; n < slope_variance_.size(); ++n)
    slope_variance_[n] = SlopeVariance(static_cast<double>(n), s_.sampling.step);
  for (Lane& size : size_)
    for (int j = 0; j < kLanes; ++j) size[j] = 0.8;  // mean of |z| of a normal variable
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

void BearingDetector::Residuals(const MeasuredPeriod& in) {
  if (any_unknown_ && model_.coupling == Coupling::kFloatingRotor)
    ComputePeriodSlopesUnknownMmf(model_, s_.sampling, in, unknown_mmf_, &slopes_);
  else
    ComputePeriodSlopes(model_, s_.sampling, in, &slopes_);
  const bool radial = model_.coupling == Coupling::kFloatingRotor;
  for (int q = 0; q < 2; ++q) {
    const PhaseSlopes& p = slopes_.phase[q];
    for (int j = 0; j < model_.coils; ++j) {
      const auto lane = static_cast<std::size_t>(j);
      const double flux = p.linkage[j] - model_.leakage[j] * p.current[j];
      const double own = model_.SelfInductance(j, slopes_.P, radial ? slopes_.total : 1);
      const double noise = own * s_.current_noise;
      const double gap = s_.gap_sd * flux, leak = s_.leakage_sd * p.current[j];
      const double variance = noise * noise * slope_variance_[static_cast<std::size_t>(p.samples[j])] +
                              gap * gap + leak * leak + s_.voltage_sd * s_.voltage_sd + in.extra_sd * in.extra_sd;
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

void BearingDetector::StepBetweenPeriods(const Lane& last_linkage, const Lane& last_off, const MeasuredPeriod& in) {
  const double h = s_.sampling.step;
  const bool radial = model_.coupling == Coupling::kFloatingRotor;
  for (int j = 0; j < model_.coils; ++j) {
    const auto lane = static_cast<std::size_t>(j);
    if (!valid_[0][lane] && !valid_[1][lane]) continue;
    if (in.adc[0][j] < kZeroCurrent) continue;
    const double own = model_.SelfInductance(j, slopes_.P, radial ? slopes_.total : 1);
    const double sd = 1.4 * own * s_.current_noise / h + 1;
    if (std::abs((slopes_.first[j] - last_linkage[j]) / h - last_off[j]) > s_.cap * sd) G_[0][j] += 2 * s_.threshold;
  }
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
      const double w = 1 / (sd_[q][j] * sd_[q][j]);
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
  const double p0 = info_[0] + 1 / (s_.leakage_sd * s_.leakage_sd), p1 = info_[2] + 1 / (s_.gap_sd * s_.gap_sd);
  const double det = p0 * p1 - info_[1] * info_[1];
  theta_[0] = std::clamp((p1 * pull_[0] - info_[1] * pull_[1]) / det, -5 * s_.leakage_sd, 5 * s_.leakage_sd);
  theta_[1] = std::clamp((p0 * pull_[1] - info_[1] * pull_[0]) / det, -5 * s_.gap_sd, 5 * s_.gap_sd);
}

int BearingDetector::Suspect() const {
  int worst = -1;
  double most = 0;
  for (int j = 0; j < model_.coils; ++j) {
    const auto lane = static_cast<std::size_t>(j);
    if (G_[0][j] + G_[1][j] + G_[2][j] <= 0) continue;
    double size = 0;
    for (int q = 0; q < 2; ++q)
      if (valid_[q][lane]) size += std::abs(e_[q][j]);
    if (size > most) {
      most = size;
      worst = j;
    }
  }
  return worst;
}

BearingDetector::Alarm BearingDetector::Period(const MeasuredPeriod& in) {
  Alarm out;
  Keep(in);
  const Lane last_linkage = slopes_.last, last_off = slopes_.phase[1].voltage;
  Residuals(in);
  const bool follows = follows_;
  follows_ = in.comparable && !any_unknown_;
  if (paused_ > 0) {
    --paused_;
    return out;
  }
  if (alarm_at_ < 0) {
    if (in.comparable) Cusum();
    if (in.comparable && follows && !any_unknown_) StepBetweenPeriods(last_linkage, last_off, in);
    bool alarm = false, calm = in.comparable;
    for (int q = 0; q < 3; ++q)
      for (int j = 0; j < model_.coils; ++j) {
        alarm = alarm || G_[q][j] > s_.threshold;
        calm = calm && G_[q][j] < 1.5;
      }
    if (calm) Learn();
    if (!alarm) return out;
    suspect_ = Suspect();
    if (suspect_ < 0)
      for (int j = 0; j < model_.coils; ++j)
        if (std::max({G_[0][j], G_[1][j], G_[2][j]}) > s_.threshold) suspect_ = j;
    alarm_at_ = count_;
    out.raised = true;
    out.coil = suspect_;
    return out;
  }
  const Diagnosis d = Examine();
  out.coil = suspect_;
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
  std::vector<const KeptPeriod*> periods;
  const long long first = std::max(0LL, count_ - kRing);
  for (long long n = first; n < count_; ++n) periods.push_back(&ring_[static_cast<std::size_t>(n % kRing)]);
  const bool last = count_ - alarm_at_ >= kLongestExamination;
  const Examination x = ExamineCoil(model_, s_, periods, suspect_, last);
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
