#include "fdd/detectors/linkage_kalman.h"

#include <cmath>

namespace ambrig {

namespace {
constexpr int kRiccatiSteps = 400;  // Riccati steps at the start
}

LinkageKalman::LinkageKalman(const CoilDetectorSetup& setup)
    : model_(setup.model), s_(setup.settings) {
  const double bus = s_.sampling.amplifier->bus_voltage;
  const double leakage =
      s_.leakage_sd / (model_.leakage[0] + model_.n[0] * model_.n[0] * model_.Permeance(0, 0)[0]);
  process_sd_ = s_.sampling.step * std::hypot(s_.voltage_sd, s_.gap_sd * bus, leakage * bus);
  lambda_.setZero();
  P_ = LinkageMatrix::Identity() * std::pow(process_sd_, 2);
  const LinkageMatrix C = InductanceOf(model_, model_.Permeance(0, 0)).inverse();
  for (int n = 0; n < kRiccatiSteps; ++n) StepCovariance(C);
}

void LinkageKalman::StepCovariance(const LinkageMatrix& C) {
  LinkageVector r = LinkageVector::Zero();
  for (int j = 0; j < model_.coils; ++j) r[j] = model_.resistance[j];
  const LinkageMatrix A = LinkageMatrix::Identity() - s_.sampling.step * r.asDiagonal() * C;
  P_ = A * P_ * A.transpose();
  for (int j = 0; j < model_.coils; ++j) P_(j, j) += process_sd_ * process_sd_;
  const LinkageMatrix PC = P_ * C.transpose();
  LinkageMatrix S = C * PC;
  S.diagonal().array() += s_.current_noise * s_.current_noise;
  gain_ = S.ldlt().solve(PC.transpose()).transpose();
  P_ -= gain_ * PC.transpose();
  P_ = 0.5 * (P_ + P_.transpose()).eval();
  sd_ = S.diagonal().cwiseSqrt();
}

void LinkageKalman::Begin(const MeasuredPeriod& in, const LinkageMatrix& L) {
  LinkageVector i = LinkageVector::Zero();
  for (int j = 0; j < model_.coils; ++j) i[j] = in.adc[0][j];
  lambda_ = L * i;
  running_ = true;
}

void LinkageKalman::Predict(const MeasuredPeriod& in, const LinkageVector& current, int k) {
  const double h = s_.sampling.step;
  for (int j = 0; j < model_.coils; ++j)
    lambda_[j] += DrivenLinkage(s_.sampling, in, j, k) - h * model_.resistance[j] * current[j];
}

Lane LinkageKalman::Period(const MeasuredPeriod& in) {
  Lane out;
  if (!in.comparable) {
    running_ = false;
    return out;
  }
  const MovingInverse inverse(model_, in);
  if (!running_) Begin(in, inverse.L0);
  StepCovariance(inverse.start + 0.5 * inverse.change);
  double judged[kLanes] = {};
  for (int k = 0; k < s_.sampling.samples; ++k) {
    const LinkageMatrix C = inverse.At(k, s_.sampling.samples);
    LinkageVector i = C * lambda_, nu = LinkageVector::Zero();
    for (int j = 0; j < model_.coils; ++j)
      if (i[j] < 0) {  // a diode blocks: the linkage follows the others' flux at zero current
        const double shift = -i[j] / C(j, j);
        lambda_[j] += shift;
        i += C.col(j) * shift;
      }
    for (int j = 0; j < model_.coils; ++j) {
      scaled_[k][j] = 0;
      if (in.adc[k][j] >= s_.adc_limit) continue;
      nu[j] = in.adc[k][j] - i[j];
      scaled_[k][j] = nu[j] / sd_[j];
      out[j] += scaled_[k][j] * scaled_[k][j];
      judged[j] += 1;
    }
    lambda_ += gain_ * nu;
    Predict(in, C * lambda_, k);
  }
  for (int j = 0; j < model_.coils; ++j) out[j] = judged[j] > 0 ? out[j] / judged[j] : 0;
  return out;
}

CoilDetectorKind KalmanOfLinkages() {
  return {"kalman",  "-",  "innovations of a filter of all linkages, chi-square over 18",
          kRequired, 11.6, MakeDetector<LinkageKalman>};
}

}  // namespace ambrig
