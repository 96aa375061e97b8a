#pragma once
/// Noise of everything that the controller measures, unit variance, from a counter-based generator:
/// a value depends on the seed, the switching period and its place only, so every fidelity and any
/// order of asking gives the same.
#include <cstdint>
#include <vector>

namespace ambrig {

class MeasurementNoise {
 public:
  /// `coils` of each bearing, `axes` position readings, `samples` ADC samples in a period;
  /// `timing`: instants of samples and edges too.
  MeasurementNoise(std::uint64_t seed, const std::vector<int>& coils, std::size_t axes, int samples,
                   bool timing);

  /// Draws what is missing of period n; then Currents(b) holds samples x coils values of the ADC
  /// samples of bearing b, readable up to seven values beyond its end.
  void DrawCurrents(long long n) { Draw(n); }
  const float* Currents(std::size_t bearing) const { return values_.data() + first_[bearing]; }
  /// Of the instants of the ADC samples of that period, one value each.
  const float* Instants() const { return values_.data() + instants_; }
  /// Of the instant at which a coil's bridge switches in period n.
  double Edge(std::size_t bearing, int coil, long long n) {
    return Draw(n)[instants_ + samples_ + coil_[bearing] + static_cast<std::size_t>(coil)];
  }
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
  std::size_t samples_;
  std::vector<std::size_t> first_;  // of each bearing in values_
  std::vector<std::size_t> coil_;   // first one of each bearing among all
  std::size_t drawn_;               // values of a period
  std::size_t instants_;            // where those of the ADC samples begin, then those of the edges
  // readings of the axes, of the bus, of the currents, instants
  std::vector<float> values_;
  long long period_;  // that values_ holds
};

}  // namespace ambrig
