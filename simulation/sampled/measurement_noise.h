#pragma once
/// Noise of everything that the controller measures, unit variance, from a counter-based generator:
/// a value depends on the seed, the switching period and its place only, so every fidelity and any
/// order of asking gives the same.
#include <cstdint>
#include <vector>

namespace ambrig {

class MeasurementNoise {
 public:
  /// `coils` of each bearing, `axes` position readings, `samples` ADC samples in a period.
  MeasurementNoise(std::uint64_t seed, const std::vector<int>& coils, std::size_t axes,
                   int samples);

  /// Draws what is missing of period n; then Currents(b) holds samples x coils values of the ADC
  /// samples of bearing b, readable up to seven values beyond its end.
  void DrawCurrents(long long n) { Draw(n); }
  const float* Currents(std::size_t bearing) const { return values_.data() + first_[bearing]; }
  /// Of the position reading of `axis` and of the bus reading of ADC sample `sample`, period n.
  double Reading(std::size_t axis, long long n) { return Draw(n)[axis]; }
  double Bus(long long n, int sample) { return Draw(n)[axes_ + static_cast<std::size_t>(sample)]; }
  /// What the bus reading of that sample shows, with noise of `rms` [V]. The record and the
  /// controller see the same one.
  double BusReading(double voltage, double rms, long long n, int sample) {
    return rms > 0 ? voltage + rms * Bus(n, sample) : voltage;
  }

 private:
  const float* Draw(long long n);

  std::uint64_t seed_;
  std::size_t axes_;
  std::vector<std::size_t> first_;  // of each bearing in values_
  std::size_t drawn_;               // values of a period
  std::vector<float> values_;       // readings of the axes, of the bus, of the currents
  long long period_;                // that values_ holds
};

}  // namespace ambrig
