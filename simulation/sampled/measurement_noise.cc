#include "simulation/sampled/measurement_noise.h"

#include <limits>

#include "core/math/noise.h"

namespace ambrig {

namespace {
constexpr std::uint32_t kStream = 100;
constexpr long long kFirst = 1LL << 40;  // periods of a warm-up are negative
std::uint64_t Index(long long n) { return static_cast<std::uint64_t>(n + kFirst); }
}  // namespace

MeasurementNoise::MeasurementNoise(std::uint64_t seed, const std::vector<int>& coils,
                                   std::size_t axes, int samples, bool timing)
    : seed_(seed),
      axes_(axes),
      samples_(static_cast<std::size_t>(samples)),
      drawn_(axes + static_cast<std::size_t>(samples)),
      period_(std::numeric_limits<long long>::min()) {
  std::size_t all = 0;
  for (int c : coils) {
    first_.push_back(drawn_);
    drawn_ += static_cast<std::size_t>(c * samples);
    coil_.push_back(all);
    all += static_cast<std::size_t>(c);
  }
  instants_ = drawn_;
  // behind the others, which stay as they are without
  if (timing) drawn_ += samples_ + all;
  values_.assign(drawn_ + 7, 0.0F);
}

const float* MeasurementNoise::Draw(long long n) {
  if (n != period_) FillNormals(seed_, kStream, Index(n), values_.data(), static_cast<int>(drawn_));
  period_ = n;
  return values_.data();
}

}  // namespace ambrig
