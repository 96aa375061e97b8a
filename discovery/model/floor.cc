#include "discovery/model/floor.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

double Rms(const std::vector<double>& v, std::size_t first, std::size_t count) {
  double sum = 0;
  for (std::size_t k = first; k < first + count; ++k) sum += v[k] * v[k];
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

/// Least that an error of this channel can mean: a step of its converter, or the file's rounding.
double Resolution(const RigParameters& rig, const std::string& channel, double full_scale) {
  const auto dot = channel.find('.');
  const char kind = channel[dot == std::string::npos ? 0 : dot + 1];
  if (kind == 'i' || kind == 's') return 1e-5 * rig.amplifier.adc_range;
  if (kind == 'd') return 1e-5;
  if (channel == "bus") return 1e-4 * rig.amplifier.bus_voltage;
  if (kind == 'f') return 1e-3;
  if (channel == "omega") return 0.05;  // [rad/s], of a free-running rotor
  return std::max(1e-9, 1e-6 * full_scale);
}

/// Samples per independent one: 1 + 2 Σ ρ², lags up to 200.
double Correlation(const std::vector<double>& v, std::size_t first, std::size_t count) {
  const double power = std::pow(Rms(v, first, count), 2);
  if (power <= 0) return 1;
  double sum = 1;
  const std::size_t lags = std::min<std::size_t>(200, count / 4);
  for (std::size_t lag = 1; lag < lags; ++lag) {
    double c = 0;
    for (std::size_t k = first; k + lag < first + count; ++k) c += v[k] * v[k + lag];
    const double rho = c / static_cast<double>(count - lag) / power;
    sum += 2 * rho * rho;
  }
  return sum;
}

}  // namespace

RigParameters WithCaseNoise(const RigParameters& rig, const std::map<std::string, double>& noise) {
  RigParameters out = rig;
  for (const auto& [channel, rms] : noise) {
    if (channel == "bus") out.amplifier.bus_noise = rms;
    for (BearingParameters& b : out.bearings)
      for (const std::string& axis : b.Axes())
        if (axis == channel) b.sensor.noise = rms;
  }
  return out;
}

NoiseFloor FindFloor(CaseModel& model, const Hypothesis& h) {
  NoiseFloor floor;
  Hypothesis noisy = h;
  noisy.rig = WithCaseNoise(h.rig, model.data().noise);
  const auto clean = model.Predict(h);
  const auto first = model.PredictNoisy(noisy, 11), second = model.PredictNoisy(noisy, 12);
  if (!clean || !first || !second)
    throw InputError(model.data().file + ": the model loses levitation in these records");
  std::vector<double> d1(clean->size()), d2(clean->size());
  for (std::size_t k = 0; k < d1.size(); ++k) {
    d1[k] = (*first)[k] - (*clean)[k];
    d2[k] = (*second)[k] - (*clean)[k];
  }
  for (Target& t : model.targets()) {
    const CaseRecord& record = model.data().records[t.record];
    const std::string& channel = record.data.channels[t.channel].name;
    const double a = Rms(d1, t.first, t.count), b = Rms(d2, t.first, t.count);
    double square = 0.5 * (a * a + b * b);
    const auto it = model.data().noise.find(channel);
    // load cells: noise of their own
    const bool reader_noise = channel.find(".f") != std::string::npos;
    if (it != model.data().noise.end())
      square = reader_noise ? square + it->second * it->second
                            : std::max(square, it->second * it->second);
    t.floor = std::max(std::sqrt(square), Resolution(h.rig, channel, t.full_scale));
  }
  // Independent rows times independent channels: the latter from the spread of their correlations.
  double rows_effective = 0;
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    std::vector<const Target*> of;
    for (const Target& t : model.targets())
      if (t.record == r) of.push_back(&t);
    if (of.empty()) continue;
    double per_channel = 0, spread = 0;
    for (const Target* t : of)
      per_channel += static_cast<double>(t->count) / Correlation(d1, t->first, t->count);
    per_channel /= static_cast<double>(of.size());
    for (const Target* a : of)
      for (const Target* b : of) {
        const double pa = Rms(d1, a->first, a->count), pb = Rms(d1, b->first, b->count);
        double c = 0;
        for (std::size_t k = 0; k < a->count; ++k) c += d1[a->first + k] * d1[b->first + k];
        const double rho =
            pa > 0 && pb > 0 ? c / static_cast<double>(a->count) / pa / pb : (a == b ? 1.0 : 0.0);
        spread += rho * rho;
      }
    rows_effective += per_channel * static_cast<double>(of.size() * of.size()) / spread;
  }
  floor.effective_sample_size = rows_effective;
  floor.clean = *clean;
  return floor;
}

}  // namespace ambrig
