#include "scenarios/measurement.h"

#include <cmath>

#include "core/math/noise.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(AMBRIG_SANITIZED)
#define AMBRIG_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define AMBRIG_WIDE
#endif

namespace ambrig {

namespace {

AMBRIG_WIDE void Average(const Lane* samples, int count, Lane* mean) {
  double sum[kLanes] = {};
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < kLanes; ++j) sum[j] += samples[k].v[j];
  for (int j = 0; j < kLanes; ++j) mean->v[j] = sum[j] / count;
}

/// Rounds to the nearest step and clips; |value / step| stays far below 2^51, where adding and
/// subtracting 1.5 * 2^52 rounds to the nearest even integer, as nearbyint does.
AMBRIG_WIDE void Convert(const Lane* truth, const float* normals, double noise, const double* gain,
                         const double* offset, double step, double low, double high, int count, Lane* adc) {
  constexpr double kRound = 6755399441055744.0;
  const double per_step = 1 / step;
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < kLanes; ++j) {
      const double value = gain[j] * truth[k].v[j] + offset[j] + noise * static_cast<double>(normals[k * kLanes + j]);
      const double q = ((value * per_step + kRound) - kRound) * step;
      const double floor = q < low ? low : q;
      adc[k].v[j] = floor > high ? high : floor;
    }
}

AMBRIG_WIDE void Statistics(const Lane* truth, int count, Lane* mean_square, Lane* largest) {
  double sum[kLanes] = {}, most[kLanes] = {};
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < kLanes; ++j) {
      sum[j] += truth[k].v[j] * truth[k].v[j];
      most[j] = truth[k].v[j] > most[j] ? truth[k].v[j] : most[j];
    }
  for (int j = 0; j < kLanes; ++j) {
    mean_square->v[j] = sum[j] / count;
    largest->v[j] = most[j];
  }
}

}  // namespace

void CurrentStatistics(const Lane* truth, int samples, Lane* mean_square, Lane* largest) {
  Statistics(truth, samples, mean_square, largest);
}

void MeasureCurrents(const MeasurementSettings& s, const Lane* truth, const CurrentSensor* sensors,
                     bool plain, std::uint64_t seed, std::uint32_t stream, std::uint64_t period,
                     Lane* adc, Lane* mean) {
  double gain[kLanes], offset[kLanes];
  for (int j = 0; j < kLanes; ++j) {
    gain[j] = plain ? 1 : (sensors[j].stuck ? 0 : sensors[j].gain);
    offset[j] = plain ? 0 : (sensors[j].stuck ? sensors[j].stuck_at : sensors[j].offset);
  }
  if (s.noisy) {
    alignas(64) float normals[64 * kLanes];
    FillNormals(seed, stream, period, normals, s.samples * kLanes);
    Convert(truth, normals, s.noise, gain, offset, s.quantiser.step, s.quantiser.low, s.quantiser.high,
            s.samples, adc);
  } else {
    for (int k = 0; k < s.samples; ++k)
      for (int j = 0; j < kLanes; ++j) adc[k].v[j] = plain ? truth[k].v[j] : gain[j] * truth[k].v[j] + offset[j];
  }
  Average(adc, s.samples, mean);
}

}  // namespace ambrig
