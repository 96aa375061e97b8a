/// Rows of the record: what the controller knows at the start of a period (formats.md "Record").
#include <cmath>

#include "scenarios/bearing_run.h"
#include "scenarios/record_layout.h"
#include "scenarios/switching_engine.h"

namespace ambrig {

void SwitchingEngine::CreateChannels() {
  const double rate = options_.record_rate > 0 ? options_.record_rate : scenario_.record_rate;
  const double per_period = rate * T_;
  if (per_period > 1 + 1e-9) {
    row_samples_ = static_cast<int>(std::lround(samples_ / per_period));
  } else {
    row_periods_ = static_cast<int>(std::lround(1 / per_period));
  }
  recorder_.emplace(rate, 0.0);
  const auto rows = static_cast<std::size_t>(std::ceil(scenario_.duration * rate)) + 1;
  channel_ = AddRecordChannels(*recorder_, rig_, clamped_, rows);
}

void SwitchingEngine::RecordRow(long long n, int sample) {
  const double inside = sample * T_ / samples_, t = static_cast<double>(n) * T_ + inside;
  std::size_t c = 0;
  const auto put = [&](double value) { recorder_->Put(channel_[c++], value); };
  const bool at_tick = sample == 0 && n % M_ == 0;
  for (std::size_t a = 0; a < loop_->axes(); ++a) put(at_tick ? loop_->readings()[a] : loop_->Reading(a, n));
  for (BearingRun& b : bearings_) {
    const BearingControl& k = control_[b.index];
    for (int j = 0; j < k.coils; ++j) put(row_samples_ > 0 ? b.adc[sample][j] : k.feedback[j]);
    for (int j = 0; j < k.coils; ++j) put(k.set_point[j]);
    for (int j = 0; j < k.coils; ++j) put(k.duty[j]);
    // Rows of a burst are written when their period is over; the load cell holds the one before it.
    put(!clamped_ ? b.true_x : row_samples_ > 0 ? b.fx_before : b.fx);
    if (b.axes > 1) put(!clamped_ ? b.true_y : row_samples_ > 0 ? b.fy_before : b.fy);
  }
  for (const auto& [name, plane] : plant_.stations) {
    if (clamped_) break;
    double x, y;
    plant_.rotor.Position(motion_, plane, &x, &y);
    put(x);
    put(y);
  }
  put(plant_.rotor.SpeedIsFree(t) ? motion_.Omega : scenario_.speed.Speed(t));
  put(plant_.rotor.SpeedIsFree(t) ? motion_.theta + motion_.Omega * inside : scenario_.speed.Angle(t));
  put(noise_->BusReading(plant_.bus.voltage, scenario_.noise ? rig_.amplifier.bus_noise : 0, n, sample));
}

}  // namespace ambrig
