#include "discovery/model/noise_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/model/model.h"

namespace ambrig {

namespace {

constexpr double kNoiseAgrees = 1.5;  // factor between stated and estimated noise
// of the currents, whose ripple a wrong law of the iron changes at every edge: more than a factor of
// two is needed before their noise is held to be larger than stated
constexpr double kCurrentAgrees = 2.5;
constexpr double kTrial = 1e-3;  // of the ADC's range: current noise where none is stated

using ByChannel = std::map<std::string, std::vector<double>>;

bool IsCurrent(const std::string& channel) { return IsOfKind(channel, ChannelKind::kCoilCurrent); }

/// Channels whose noise is their sensor's own, not what comes round the control loop.
bool IsDirect(const std::string& channel) {
  return IsOfKind(channel, ChannelKind::kBus) || IsOfKind(channel, ChannelKind::kLoadCell) ||
         IsOfKind(channel, ChannelKind::kReading);
}

std::string BusName() { return ChannelId{ChannelKind::kBus}.name(); }

/// White noise of a - b in every target, by channel.
template <class Chosen>
ByChannel WhiteParts(const CaseModel& model, const std::vector<double>& a,
                     const std::vector<double>& b, const Chosen& chosen) {
  ByChannel out;
  for (const Target& t : model.targets()) {
    const std::string& channel = model.data().records[t.record].data.channels[t.channel].name;
    if (!chosen(channel)) continue;
    std::vector<double> error(t.count);
    for (std::size_t k = 0; k < t.count; ++k) error[k] = a[t.first + k] - b[t.first + k];
    out[channel].push_back(WhiteNoiseOf(error.data(), model.ok().data() + t.first, t.count));
  }
  return out;
}

/// `larger`: factor by which the estimate may exceed what is stated.
void Choose(ChannelNoise& c, double larger = kNoiseAgrees) {
  const bool usable = std::isfinite(c.estimated) && c.estimated > 0;
  const bool agrees = std::isfinite(c.stated) && usable && c.estimated < larger * c.stated &&
                      c.stated < kNoiseAgrees * c.estimated;
  c.used = agrees || !usable ? (std::isfinite(c.stated) ? c.stated : 0) : c.estimated;
}

/// rms of one ADC sample of a current, of every coil, from the white part of the currents: what
/// comes through the set-points is taken off.
void EstimateCurrents(const CaseModel& model, const Hypothesis& h, const std::vector<double>& clean,
                      NoiseModel& noise) {
  const ByChannel measured = WhiteParts(model, model.measured(), clean, IsCurrent);
  if (measured.empty()) return;
  const double stated = h.rig.amplifier.current_noise;
  const double trial = stated > 0 ? stated : kTrial * h.rig.amplifier.adc_range;
  const auto run = [&](double sample) {
    Hypothesis trial_rig = h;
    trial_rig.rig = WithNoise(h.rig, noise);
    trial_rig.rig.amplifier.current_noise = sample;
    return model.PredictNoisy(trial_rig, 21);
  };
  const auto with = run(trial), without = run(0);
  if (!with || !without) return;
  const ByChannel own = WhiteParts(model, *with, clean, IsCurrent),
                  loop = WhiteParts(model, *without, clean, IsCurrent);
  std::vector<double> all;
  for (const auto& [channel, parts] : measured) {
    std::vector<double> factors, sizes;  // against the trial's, and the trial's in the record
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double m = std::pow(parts[k], 2), a = std::pow(own.at(channel)[k], 2),
                   b = std::pow(loop.at(channel)[k], 2);
      // a record whose white part is the loop's says nothing of the sensor
      if (!(a > 1.3 * b)) continue;
      factors.push_back(std::sqrt(std::max(0.0, m - b) / (a - b)));
      sizes.push_back(std::sqrt(a - b));
    }
    const double factor = LowerQuartileOf(factors), size = MedianOf(sizes);
    ChannelNoise& c = noise.channels[channel];
    if (stated > 0 && std::isnan(c.stated)) c.stated = size;
    c.estimated = factor * size;
    Choose(c, kCurrentAgrees);
    all.push_back(trial * factor);
  }
  ChannelNoise common;
  common.stated = stated > 0 ? stated : std::nan("");
  common.estimated = MedianOf(all);
  Choose(common, kCurrentAgrees);
  if (common.used != stated && std::isfinite(common.estimated)) noise.current_sample = common.used;
}

}  // namespace

double NoiseModel::Used(const std::string& channel) const {
  const auto it = channels.find(channel);
  return it == channels.end() ? std::numeric_limits<double>::quiet_NaN() : it->second.used;
}

NoiseModel StatedNoise(const RigParameters& rig, const std::map<std::string, double>& of_case) {
  NoiseModel noise;
  const auto state = [&](const std::string& channel, double rms) {
    noise.channels[channel].stated = noise.channels[channel].used = rms;
  };
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& axis : b.Axes())
      if (b.sensor.noise > 0) state(axis, b.sensor.noise);
  if (rig.amplifier.bus_noise > 0) state(BusName(), rig.amplifier.bus_noise);
  for (const auto& [channel, rms] : of_case) state(channel, rms);
  return noise;
}

RigParameters WithNoise(const RigParameters& rig, const NoiseModel& noise) {
  RigParameters out = rig;
  if (std::isfinite(noise.current_sample)) out.amplifier.current_noise = noise.current_sample;
  if (const double bus = noise.Used(BusName()); std::isfinite(bus)) out.amplifier.bus_noise = bus;
  for (BearingParameters& b : out.bearings) {
    double square = 0, n = 0;  // both axes of a sensor have one number
    for (const std::string& axis : b.Axes())
      if (const double rms = noise.Used(axis); std::isfinite(rms)) square += rms * rms, n += 1;
    if (n > 0) b.sensor.noise = std::sqrt(square / n);
  }
  return out;
}

NoiseModel EstimateNoise(const CaseModel& model, const Hypothesis& h) {
  NoiseModel noise = StatedNoise(h.rig, model.data().noise);
  const auto clean = model.Predict(h);
  if (!clean) return noise;
  const ByChannel direct = WhiteParts(model, model.measured(), *clean, IsDirect);
  for (const auto& [channel, parts] : direct) {
    ChannelNoise& c = noise.channels[channel];
    c.estimated = LowerQuartileOf(parts);  // a model's error only adds to it
    Choose(c);
  }
  EstimateCurrents(model, h, *clean, noise);
  noise.estimated = true;
  return noise;
}

std::vector<std::string> NoiseRemarks(const NoiseModel& noise) {
  std::vector<std::string> out;
  for (const auto& [channel, c] : noise.channels) {
    if (!std::isfinite(c.estimated) || c.used != c.estimated || c.used == c.stated) continue;
    out.push_back(std::isfinite(c.stated)
                      ? fmt::format("noise of {}: stated {:.3g}, the records show {:.3g}: the "
                                    "latter is used",
                                    channel, c.stated, c.estimated)
                      : fmt::format("noise of {}: not stated, estimated from the records: {:.3g}",
                                    channel, c.estimated));
  }
  return out;
}

}  // namespace ambrig
