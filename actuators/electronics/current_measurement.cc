#include "actuators/electronics/current_measurement.h"

#include <algorithm>

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

/// Rounds to the nearest step and clips; |value / step| stays far below 2^51, where adding and
/// subtracting 1.5 * 2^52 rounds to the nearest even integer, as nearbyint does.
struct Converter {
  double step, low, high;
  template <bool kClips, class V>
  [[gnu::always_inline]] V Convert(const V& value) const {
    constexpr double kRound = 6755399441055744.0;
    const V q = ((value * (1 / step) + kRound) - kRound) * step;
    if constexpr (kClips)
      return Min(Max(q, low), high);
    else
      return q;
  }
};

constexpr double kLargestNormal = 6.3;  // core/math/noise.h

struct Sensors {
  const double *gain, *offset;  // nullptr: ideal
};

struct Sampling {
  int count = 0;
  const SampleInstants& at;
};

template <class V, class Convert>
[[gnu::always_inline]] inline void Measure(const Lane* truth, const Sampling& sampling,
                                           const Sensors& sensors, const Convert& convert,
                                           Lane* adc, CurrentStatistics* out) {
  const bool plain = sensors.gain == nullptr;
  const V gain = plain ? V(1) : LoadAs<V>(sensors.gain),
          offset = plain ? V() : LoadAs<V>(sensors.offset);
  V sum = {}, square = {}, most = {};
  const int count = sampling.count;
  for (int k = 0; k < count; ++k) {
    const V i = LoadAs<V>(truth[k].v);
    V seen = i;
    if (!sampling.at.exact)
      seen = i + (LoadAs<V>(truth[sampling.at.neighbour[k]].v) - i) * sampling.at.toward[k];
    const V value = convert(plain ? seen : gain * seen + offset, k);
    Store(adc[k].v, value);
    sum += value;
    square += i * i;
    most = Max(Abs(i), most);
  }
  Store(out->mean.v, sum / static_cast<double>(count));
  Store(out->mean_square.v, square / static_cast<double>(count));
  Store(out->largest.v, most);
}

template <bool kClips, class V>
[[gnu::always_inline]] inline void ConvertNoisily(const Lane* truth, const Sampling& sampling,
                                                  const Sensors& sensors, const float* normals,
                                                  int coils, double noise,
                                                  const Converter& converter, Lane* adc,
                                                  CurrentStatistics* out) {
  const Converter c = converter;
  Measure<V>(
      truth, sampling, sensors,
      [&](const V& value, int k) __attribute__((always_inline)) {
        Lane normal;
        for (int j = 0; j < kLanes; ++j) normal[j] = static_cast<double>(normals[k * coils + j]);
        return c.Convert<kClips>(value + noise * LoadAs<V>(normal.v));
      },
      adc, out);
}

/// Currents that flow `one_way` leave a converter's range upwards only, which their largest tells,
/// at `per_ampere` of it: from one sample to the next they change by less than it.
template <class V>
[[gnu::always_inline]] inline void MeasureNoisily(const Lane* truth, const Sampling& sampling,
                                                  double per_ampere, bool one_way,
                                                  const Sensors& sensors, const float* normals,
                                                  int coils, double noise,
                                                  const Converter& converter, Lane* adc,
                                                  CurrentStatistics* out) {
  if (!one_way)
    return ConvertNoisily<true, V>(truth, sampling, sensors, normals, coils, noise, converter, adc,
                                   out);
  ConvertNoisily<false, V>(truth, sampling, sensors, normals, coils, noise, converter, adc, out);
  if (!(Largest(LoadAs<V>(out->largest.v)) * per_ampere + kLargestNormal * noise + converter.step <
        converter.high))
    ConvertNoisily<true, V>(truth, sampling, sensors, normals, coils, noise, converter, adc, out);
}

template <class V>
[[gnu::always_inline]] inline void Ideally(const Lane* truth, const Sampling& sampling,
                                           const Sensors& sensors, Lane* adc,
                                           CurrentStatistics* out) {
  Measure<V>(
      truth, sampling, sensors,
      [](const V& value, int) __attribute__((always_inline)) { return value; }, adc, out);
}

AMBRIG_WHOLE void IdeallyWhole(const Lane* truth, const Sampling& sampling, const Sensors& sensors,
                               Lane* adc, CurrentStatistics* out) {
  Ideally<WholeLaneVector>(truth, sampling, sensors, adc, out);
}
AMBRIG_WIDE void IdeallyHalves(const Lane* truth, const Sampling& sampling, const Sensors& sensors,
                               Lane* adc, CurrentStatistics* out) {
  Ideally<LaneVector>(truth, sampling, sensors, adc, out);
}
AMBRIG_WHOLE void NoisilyWhole(const Lane* truth, const Sampling& sampling, double per_ampere,
                               bool one_way, const Sensors& sensors, const float* normals,
                               int coils, double noise, const Converter& converter, Lane* adc,
                               CurrentStatistics* out) {
  MeasureNoisily<WholeLaneVector>(truth, sampling, per_ampere, one_way, sensors, normals, coils,
                                  noise, converter, adc, out);
}
AMBRIG_WIDE void NoisilyHalves(const Lane* truth, const Sampling& sampling, double per_ampere,
                               bool one_way, const Sensors& sensors, const float* normals,
                               int coils, double noise, const Converter& converter, Lane* adc,
                               CurrentStatistics* out) {
  MeasureNoisily<LaneVector>(truth, sampling, per_ampere, one_way, sensors, normals, coils, noise,
                             converter, adc, out);
}

const SampleInstants kOnTime{};

}  // namespace

void SampleInstants::Set(int samples, double jitter, const float* normals) {
  exact = jitter == 0;
  for (int k = 0; k < samples && !exact; ++k) {
    const double late = jitter * static_cast<double>(normals[k]);
    const int there = k == 0 || (late > 0 && k + 1 < samples) ? k + 1 : k - 1;
    neighbour[k] = there;
    toward[k] = late * (there - k);
  }
}

void MeasureCurrents(const MeasurementSettings& s, const Lane* truth, const CurrentSensor* sensors,
                     bool plain, const MeasurementErrors& errors, Lane* adc,
                     CurrentStatistics* statistics) {
  Lane gain, offset;
  double most = 1;        // gain
  bool from_zero = true;  // readings of currents that are not below zero
  for (int j = 0; j < kLanes && !plain; ++j) {
    gain[j] = sensors[j].stuck ? 0 : sensors[j].gain;
    offset[j] = sensors[j].stuck ? sensors[j].stuck_at : sensors[j].offset;
    from_zero = from_zero && gain[j] >= 0 && offset[j] == 0;
    most = std::max(most, gain[j]);
  }
  const Sensors chain = plain ? Sensors{nullptr, nullptr} : Sensors{gain.v, offset.v};
  if (!s.noisy) {
    const auto ideally = whole_lanes ? IdeallyWhole : IdeallyHalves;
    return ideally(truth, {s.samples, kOnTime}, chain, adc, statistics);
  }
  const double lowest = most * s.jitter * s.quantiser.high + s.noise;
  const bool one_way =
      s.one_way && from_zero && kLargestNormal * lowest + s.quantiser.step < -s.quantiser.low;
  const Converter converter{s.quantiser.step, s.quantiser.low, s.quantiser.high};
  (whole_lanes ? NoisilyWhole : NoisilyHalves)(
      truth, {s.samples, errors.instants}, most * (1 + kLargestNormal * s.jitter), one_way, chain,
      errors.readings, s.coils, s.noise, converter, adc, statistics);
}

}  // namespace ambrig
