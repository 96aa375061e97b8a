#include "fdd/detectors/linkage_phases.h"

#include <algorithm>
#include <cmath>

#include "fdd/circuit/inductance_matrix.h"

namespace ambrig {

namespace {

constexpr double kGrossShort = 0.5, kGrossSensor = -0.4;  // c of both phases
constexpr double kStuckDown = -1.5, kStuckUp = 0.3;       // c of a switch that stays on
constexpr double kSdOfRatio = 0.06;                       // of c, by the noise of the samples
constexpr int kLeastWindow = 3, kMostWindow = 250;        // periods
constexpr double kCarries = 3;   // times kConducts: a mean current that is one
constexpr double kMostSd = 0.2;  // of a c that tells something: a phase of a few samples does not

}  // namespace

LinkagePhases::LinkagePhases(const LinkageModel& model, const SamplingSettings& sampling,
                             double noise)
    : model_(model), sampling_(sampling) {
  share_.fill(1);
  before_.fill(FaultClass::kNone);
  const WindingMatrix L = InductanceAt(0, 0);
  double largest = 0;
  for (int j = 0; j < model_.coils; ++j) largest = std::max(largest, L(j, j) + model_.leakage[j]);
  // Of one phase of a period: two samples' noise over the linkage of half a period.
  const double driven = 0.5 * sampling_.samples * sampling_.step * sampling_.amplifier->bus_voltage;
  const double sd = std::sqrt(2.0) * largest * noise / driven;
  least_square_ = std::pow(sd * driven / kMostSd, 2);
  window_ = std::clamp(static_cast<int>(std::ceil(std::pow(sd / kSdOfRatio, 2))), kLeastWindow,
                       kMostWindow);
}

WindingMatrix LinkagePhases::InductanceAt(double x, double y) const {
  return model_.network->Linkage(model_.network->FluxAt({x, y, 0}).phi);
}

Lane LinkagePhases::LinkagesOf(const WindingMatrix& L, const Lane& current) const {
  Lane out;
  for (int j = 0; j < model_.coils; ++j) {
    double sum = L(j, model_.coils);
    for (int k = 0; k < model_.coils; ++k) sum += L(j, k) * share(k) * current[k];
    out[j] = share(j) * sum + share(j) * share(j) * model_.leakage[j] * current[j];
  }
  return out;
}

Lane LinkagePhases::Linkages(const Lane& current, double x, double y) const {
  return LinkagesOf(InductanceAt(x, y), current);
}

void LinkagePhases::Begin() {
  seen_ = 0;
  up_.fill({});
  down_.fill({});
  current_ = Lane{};
  for (int j = 0; j < kLanes; ++j) least_current_[j] = kInfinity;
}

void LinkagePhases::Add(const MeasuredPeriod& in) {
  const int n = sampling_.samples;
  const bool one_way = sampling_.amplifier->quadrants < 3;
  // The place goes linearly through the period, and so do the inductances.
  const WindingMatrix start = InductanceAt(in.x0, in.y0),
                      change = (InductanceAt(in.x1, in.y1) - start) / n;
  Lane before = LinkagesOf(start, in.adc[0]);
  std::array<Phase, kLanes> up{}, down{};  // here: Σ E, Σ D of this period
  for (int k = 0; k + 1 < n; ++k) {
    const Lane now = LinkagesOf(start + (k + 1.0) * change, in.adc[k + 1]);
    for (int j = 0; j < model_.coils; ++j) {
      const double i0 = in.adc[k][j], i1 = in.adc[k + 1][j];
      current_[j] += std::abs(i0) / (n - 1);
      least_current_[j] = std::min(least_current_[j], std::abs(i0));
      if (one_way && std::min(i0, i1) < kConducts) continue;
      const double D = DrivenLinkage(sampling_, in, j, k) -
                       share(j) * model_.resistance[j] * 0.5 * (i0 + i1) * sampling_.step;
      Phase& phase = (D > 0 ? up : down)[static_cast<std::size_t>(j)];
      phase.product += now[j] - before[j] - D;
      phase.square += D;
    }
    before = now;
  }
  for (std::size_t j = 0; j < kLanes; ++j) {
    up_[j].product += up[j].product * up[j].square;
    up_[j].square += up[j].square * up[j].square;
    down_[j].product += down[j].product * down[j].square;
    down_[j].square += down[j].square * down[j].square;
  }
}

FaultClass LinkagePhases::ClassOf(int j, double* fraction) const {
  const auto lane = static_cast<std::size_t>(j);
  *fraction = 0;
  const bool tells_up = up_[lane].square > least_square_;
  if (down_[lane].square <= least_square_) return FaultClass::kNone;
  // Without a current a coil is broken, or its diodes block.
  const bool carries = current_[j] >= kCarries * kConducts * seen_ || least_current_[j] > kConducts;
  if (!carries && sampling_.amplifier->quadrants < 3) return FaultClass::kNone;
  const double rising = up_[lane].c(), falling = down_[lane].c();
  // The current loop soon asks for no drive up at all: what rises under a drive down
  // is enough then.
  if (falling < kStuckDown && (!tells_up || std::abs(rising) < kStuckUp))
    return FaultClass::kSwitchStuckOn;
  if (!tells_up) return FaultClass::kNone;
  if (std::max(rising, falling) < kGrossSensor)
    return carries ? FaultClass::kCurrentSensor : FaultClass::kNone;
  if (std::min(rising, falling) < kGrossShort) return FaultClass::kNone;
  *fraction = 1 - 1 / std::sqrt(1 + 0.5 * (rising + falling));
  return FaultClass::kPartialShort;
}

Diagnosis LinkagePhases::Decide(double end, const std::array<bool, kLanes>& lost) {
  Diagnosis worst;
  double farthest = 0;
  for (int j = 0; j < model_.coils; ++j) {
    const auto lane = static_cast<std::size_t>(j);
    double fraction = 0;
    const FaultClass now = lost[lane] ? FaultClass::kNone : ClassOf(j, &fraction);
    const bool again = now != FaultClass::kNone && now == before_[lane];
    if (now != before_[lane]) onset_[lane] = start_;
    before_[lane] = now;
    const double far = std::abs(up_[lane].c()) + std::abs(down_[lane].c());
    if (!again || far <= farthest) continue;
    farthest = far;
    worst.coil = j;
    worst.cls = now;
    worst.fraction = fraction;
    worst.time = end;
    worst.onset = onset_[lane];
    worst.confidence = 1;
  }
  if (worst.cls != FaultClass::kNone) before_.fill(FaultClass::kNone);
  if (worst.cls == FaultClass::kPartialShort)
    share_[static_cast<std::size_t>(worst.coil)] *= 1 - worst.fraction;
  return worst;
}

Diagnosis LinkagePhases::Period(const MeasuredPeriod& in, const std::array<bool, kLanes>& lost) {
  if (!in.comparable || in.uncertainty.any()) {
    Begin();
    return {};
  }
  if (seen_ == 0) start_ = in.t;
  Add(in);
  if (++seen_ < window_) return {};
  const Diagnosis d = Decide(in.t + sampling_.samples * sampling_.step, lost);
  Begin();
  return d;
}

}  // namespace ambrig
