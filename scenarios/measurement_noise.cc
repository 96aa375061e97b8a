#include "scenarios/measurement_noise.h"

#include <limits>

#include "core/math/noise.h"

namespace ambrig {

namespace {
enum Stream : std::uint32_t { kCurrents = 100, kOthers = 200 };
constexpr long long kFirst = 1LL << 40;  // periods of a warm-up are negative
std::uint64_t Index(long long n) { return static_cast<std::uint64_t>(n + kFirst); }
}  // namespace

MeasurementNoise::MeasurementNoise(std::uint64_t seed, const std::vector<int>& coils, std::size_t axes, int samples)
    : seed_(seed), axes_(axes), others_of_(std::numeric_limits<long long>::min()) {
  for (int c : coils) {
    first_.push_back(drawn_);
    drawn_ += static_cast<std::size_t>(c * samples);
  }
  currents_.assign(drawn_ + 7, 0.0F);
  others_.assign(axes + static_cast<std::size_t>(samples), 0.0F);
}

void MeasurementNoise::DrawCurrents(long long n) {
  FillNormals(seed_, kCurrents, Index(n), currents_.data(), static_cast<int>(drawn_));
}

const float* MeasurementNoise::Others(long long n) {
  if (n != others_of_) FillNormals(seed_, kOthers, Index(n), others_.data(), static_cast<int>(others_.size()));
  others_of_ = n;
  return others_.data();
}

}  // namespace ambrig
