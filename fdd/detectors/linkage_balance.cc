#include "fdd/detectors/linkage_balance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fdd/circuit/inductance_matrix.h"
#include "fdd/detectors/linkage_phases.h"
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

namespace {

constexpr double kShareOfBus =
    0.12;                          // threshold: what tolerances of the gap and leakage leave, ...
constexpr double kNoises = 7;      // ... and sd of the noise
constexpr double kLeastAsked = 3;  // times kConducts: a set-point that says something
constexpr double kFaster = 3;      // than the coil's own inductance lets it fall: neighbours, drops
constexpr int kPeriodsInARow = 3;  // periods

class LinkageBalance : public RunDetector {
 public:
  explicit LinkageBalance(const RunDetectorSetup& setup)
      : model_(setup.model),
        s_(setup.settings),
        phases_(setup.model, setup.settings.sampling, setup.settings.current_noise) {
    Require(model_.network != nullptr, "a stator with a network");
    const WindingMatrix L = model_.network->Linkage(FluxAt(0, 0));
    const double T = s_.sampling.samples * s_.sampling.step;
    double largest = 0;
    for (int j = 0; j < model_.coils; ++j) largest = std::max(largest, L(j, j) + model_.leakage[j]);
    for (int j = 0; j < model_.coils; ++j)
      fastest_[j] = kFaster * s_.sampling.step * s_.sampling.amplifier->bus_voltage /
                    (L(j, j) + model_.leakage[j]);
    const double noise = std::sqrt(2.0) * largest * s_.current_noise / T;
    threshold_ = kShareOfBus * s_.sampling.amplifier->bus_voltage + kNoises * noise;
  }

  DetectorAlarm Period(const MeasuredPeriod& in) override {
    DetectorAlarm alarm;
    const Lane now = phases_.Linkages(in.adc[0], in.x0, in.y0);
    for (int j = 0; j < model_.coils; ++j) {
      if (last_ && !lost_[static_cast<std::size_t>(j)]) Judge(in, now, j, alarm);
    }
    if (alarm.coil < 0) JudgePhases(in, alarm);
    last_ = phases_.Linkages(in.adc[0], in.x0, in.y0);
    driven_ = DrivenOver(in);
    comparable_ = in.comparable && !in.uncertainty.any();
    return alarm;
  }

  SlopeBand Band(int coil) const override { return {balance_[coil], 0, threshold_}; }

 private:
  PoleMatrix FluxAt(double x, double y) const { return model_.network->FluxAt({x, y, 0}).phi; }

  /// ∫ (v - R i) dt over the period that its duty and samples belong to [Wb].
  Lane DrivenOver(const MeasuredPeriod& in) const {
    Lane out;
    for (int j = 0; j < model_.coils; ++j)
      for (int k = 0; k < s_.sampling.samples; ++k)
        out[j] += DrivenLinkage(s_.sampling, in, j, k) -
                  phases_.share(j) * model_.resistance[j] * in.adc[k][j] * s_.sampling.step;
    return out;
  }

  void Judge(const MeasuredPeriod& in, const Lane& now, int j, DetectorAlarm& alarm) {
    const double T = s_.sampling.samples * s_.sampling.step;
    const auto lane = static_cast<std::size_t>(j);
    balance_[j] = (now[j] - (*last_)[j] - driven_[j]) / T;
    double largest = 0;
    for (int k = 0; k < s_.sampling.samples; ++k) {
      const double i = std::abs(in.adc[k][j]);
      largest = std::max(largest, i);
      if (i <= kConducts && before_[j] > kConducts) jump_[j] = before_[j] - i;
      before_[j] = i;
    }
    const double asked = in.set_point ? std::abs((*in.set_point)[j]) : 0;
    const bool off = std::abs(balance_[j]) > threshold_ && comparable_ && in.comparable;
    // Diodes that block leave a coil without current too, when little is asked of it.
    const bool told = s_.sampling.amplifier->quadrants > 2 || asked > kLeastAsked * kConducts;
    const bool suspicious = largest < kConducts && told && (off || count_[lane] > 0);
    if (!suspicious) {
      if (count_[lane] > 0 && alarm.coil < 0) {
        alarm.coil = j;
        alarm.cleared = raised_[lane];
      }
      raised_[lane] = false;
      count_[lane] = 0;
      return;
    }
    if (count_[lane]++ == 0) {
      onset_[lane] = in.t;
      if (alarm.coil < 0) {
        alarm.coil = j;
        alarm.raised = raised_[lane] = true;
      }
    }
    if (count_[lane] < kPeriodsInARow) return;
    lost_[lane] = true;
    Diagnosis d;
    d.coil = j;
    d.cls = jump_[j] > 0 && jump_[j] < fastest_[j] ? FaultClass::kAmplifierOff : FaultClass::kOpen;
    d.time = in.t + T;
    d.onset = onset_[lane];
    d.confidence = 1;
    if (alarm.diagnosis.cls == FaultClass::kNone) {
      alarm.coil = j;
      alarm.raised = alarm.cleared = false;
      alarm.diagnosis = d;
    } else {
      alarm.more.push_back(d);
    }
  }

  /// Coils that carry current with wrong slopes.
  void JudgePhases(const MeasuredPeriod& in, DetectorAlarm& alarm) {
    const Diagnosis d = phases_.Period(in, lost_);
    if (d.cls == FaultClass::kNone) return;
    alarm.coil = d.coil;
    alarm.diagnosis = d;
    if (d.cls != FaultClass::kPartialShort) lost_[static_cast<std::size_t>(d.coil)] = true;
  }

  LinkageModel model_;
  DetectorSettings s_;
  LinkagePhases phases_;
  double threshold_ = 0;      // [V]
  std::optional<Lane> last_;  // λ at the start of the last period [Wb]
  Lane driven_, balance_;     // [Wb], [V]
  bool comparable_ = false;
  Lane before_, jump_;  // |i| of the last sample; its last step to nothing [A]
  Lane fastest_;        // that a bridge which blocks could make of it in a sample [A]
  std::array<int, kLanes> count_{};
  std::array<double, kLanes> onset_{};
  std::array<bool, kLanes> lost_{}, raised_{};
};

}  // namespace

std::unique_ptr<RunDetector> MakeLinkageBalance(const RunDetectorSetup& setup) {
  return std::make_unique<LinkageBalance>(setup);
}

}  // namespace ambrig
