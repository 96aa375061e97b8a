#include "discovery/model/noise_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "actuators/electronics/adc.h"
#include "core/record/channels.h"
#include "discovery/data/held_values.h"
#include "discovery/data/noise_estimate.h"
#include "discovery/model/case_model.h"
#include "discovery/model/filtered_noise.h"

namespace ambrig {

namespace {

constexpr double kNoiseAgrees = 1.5;  // factor between stated and estimated noise
// of the currents, whose ripple a wrong law of the iron changes at every edge: more than a factor
// of two is needed before their noise is held to be larger than stated
constexpr double kCurrentAgrees = 2.5;
// What is the same in every record is noise: a law that the model lacks acts more in one than in
// another. Largest over smallest estimate of the records, outer tenths left out.
constexpr double kUniform = 1.35;
// Factor between stated and estimated noise where it is uniform.
constexpr double kUniformAgrees = 1.1;
constexpr std::size_t kLeastEstimates = 3;
constexpr double kFilteredAgrees = 1.25;  // stated noise over the least error of the records
constexpr double kTrial = 1e-3;           // of the ADC's range: current noise where none is stated
// Of a code of the ADC, and at most of the trial's noise: with less the errors of its codes are no
// noise, and may be larger than they are with noise.
constexpr double kDither = 0.5, kMostDither = 0.5;
constexpr int kMostTrials = 3;  // of another current noise than stated
constexpr double kNear = 0.1;   // of the noise tried

using ByChannel = std::map<std::string, std::vector<double>>;

bool IsCurrent(const std::string& channel) { return IsOfKind(channel, ChannelKind::kCoilCurrent); }

/// Channels whose noise is their sensor's own, not what comes round the control loop.
bool IsDirect(const std::string& channel) {
  return IsOfKind(channel, ChannelKind::kBus) || IsOfKind(channel, ChannelKind::kLoadCell) ||
         IsOfKind(channel, ChannelKind::kReading);
}

std::string BusName() { return ChannelId{ChannelKind::kBus}.name(); }

/// Rows in which a reading is new: a record that is faster than the controller repeats it, and the
/// differences of equal neighbours have no noise.
std::vector<std::size_t> NewRows(const double* measured, std::size_t count) {
  const std::vector<double> y(measured, measured + count);
  const bool held = RegularHold(y) > 1;
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < count; ++k)
    if (!held || k == 0 || y[k] != y[k - 1]) rows.push_back(k);
  return rows;
}

/// White noise of a - b in every target over time, by channel. Points stand over their own sd.
template <class Chosen>
ByChannel WhiteParts(const CaseModel& model, const std::vector<double>& a,
                     const std::vector<double>& b, const Chosen& chosen) {
  ByChannel out;
  for (const Target& t : model.targets()) {
    const CaseRecord& record = model.data().records[t.record];
    const std::string& channel = record.data.channels[t.channel].name;
    if (!OverTime(record) || !chosen(channel)) continue;
    std::vector<double> error;
    std::vector<char> ok;
    for (const std::size_t k : NewRows(model.measured().data() + t.first, t.count)) {
      error.push_back(a[t.first + k] - b[t.first + k]);
      ok.push_back(model.ok()[t.first + k]);
    }
    out[channel].push_back(WhiteNoiseOf(error.data(), ok.data(), error.size()));
  }
  return out;
}

/// rms of a - b of every channel in the record over time where it is least.
std::map<std::string, double> QuietestErrors(const CaseModel& model, const std::vector<double>& a,
                                             const std::vector<double>& b) {
  std::map<std::string, double> out;
  for (const Target& t : model.targets()) {
    if (!OverTime(model.data().records[t.record])) continue;
    double square = 0, rows = 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      if (!model.ok()[k]) continue;
      square += (a[k] - b[k]) * (a[k] - b[k]);
      rows += 1;
    }
    if (rows == 0) continue;
    const std::string& channel = model.data().records[t.record].data.channels[t.channel].name;
    const double rms = std::sqrt(square / rows);
    const auto [it, first] = out.try_emplace(channel, rms);
    if (!first) it->second = std::min(it->second, rms);
  }
  return out;
}

/// Whether the estimates are the same within what differences of finite records scatter.
bool AreAlike(const std::vector<double>& estimates) {
  if (estimates.size() < kLeastEstimates) return false;
  const double low = QuantileOf(estimates, 0.1), high = QuantileOf(estimates, 0.9);
  return low > 0 && high < kUniform * low;
}

/// `larger`, `smaller`: factors by which the estimate may be off what is stated.
void Choose(ChannelNoise& c, double larger, double smaller = kNoiseAgrees) {
  const bool usable = std::isfinite(c.estimated) && c.estimated > 0;
  const bool agrees = std::isfinite(c.stated) && usable && c.estimated < larger * c.stated &&
                      c.stated < smaller * c.estimated;
  c.used = agrees || !usable ? (std::isfinite(c.stated) ? c.stated : 0) : c.estimated;
}

/// Current noise that spreads a reading over the codes of the ADC [A].
double DitherOf(const AmplifierParameters& a, double trial) {
  return std::min(kDither * Quantiser(a.adc_bits, a.adc_range).step, kMostDither * trial);
}

/// White parts of the currents against those of runs with a noise that is tried.
struct CurrentTrial {
  struct Parts {
    std::vector<double> factors;  // of the records: measured over tried noise [-]
    double size = 0;              // what the tried noise makes of the channel [A]
  };
  std::map<std::string, Parts> channels;
  std::vector<double> every;  // factors of all channels and records
  std::size_t records = 0;    // that tell something, of the channel that has most

  double together() const { return MedianOf(every); }
};

/// With this noise of an ADC sample, and with little: what comes through the set-points and of the
/// ADC's codes is taken off. Nothing where the rotor is lost.
std::optional<CurrentTrial> TryCurrentNoise(const CaseModel& model, const Hypothesis& h,
                                            const NoiseModel& noise, const ByChannel& measured,
                                            const std::vector<double>& clean, double sample) {
  const auto run = [&](double rms) {
    Hypothesis tried = h;
    tried.rig = WithNoise(h.rig, noise);
    tried.rig.amplifier.current_noise = rms;
    return model.PredictNoisy(tried, 21);
  };
  const double dither = DitherOf(h.rig.amplifier, sample), left = std::pow(dither / sample, 2);
  const auto with = run(sample), without = run(dither);
  if (!with || !without) return std::nullopt;
  const ByChannel own = WhiteParts(model, *with, clean, IsCurrent),
                  loop = WhiteParts(model, *without, clean, IsCurrent);
  CurrentTrial out;
  for (const auto& [channel, parts] : measured) {
    CurrentTrial::Parts& found = out.channels[channel];
    std::vector<double> sizes;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double m = std::pow(parts[k], 2), a = std::pow(own.at(channel)[k], 2),
                   b = std::pow(loop.at(channel)[k], 2);
      // a record whose white part is the loop's says nothing of the sensor
      if (!(a > 1.3 * b)) continue;
      found.factors.push_back(std::sqrt(std::max(0.0, left + (1 - left) * (m - b) / (a - b))));
      sizes.push_back(std::sqrt((a - b) / (1 - left)));
    }
    found.size = MedianOf(sizes);
    out.every.insert(out.every.end(), found.factors.begin(), found.factors.end());
    out.records = std::max(out.records, found.factors.size());
  }
  return out;
}

/// rms of one ADC sample of a current, of every coil, from the white part of the currents. Codes of
/// an ADC do not add to noise as noise does, so that a noise which is far off is tried again.
void EstimateCurrents(const CaseModel& model, const Hypothesis& h, const std::vector<double>& clean,
                      NoiseModel& noise) {
  const ByChannel measured = WhiteParts(model, model.measured(), clean, IsCurrent);
  if (measured.empty()) return;
  const double stated = h.rig.amplifier.current_noise;
  const double first = stated > 0 ? stated : kTrial * h.rig.amplifier.adc_range;
  double tried = first;
  auto trial = TryCurrentNoise(model, h, noise, measured, clean, tried);
  if (!trial) return;
  for (int again = 0; again < kMostTrials && std::abs(trial->together() - 1) > kNear; ++again) {
    const double next = tried * std::clamp(trial->together(), 0.1, 10.0);
    auto better = TryCurrentNoise(model, h, noise, measured, clean, next);
    if (!better || better->records < trial->records) break;
    trial = std::move(better);
    tried = next;
  }
  // the coils of one record may all miss the same law
  const bool uniform = trial->records >= kLeastEstimates && AreAlike(trial->every);
  const double together = trial->together();
  const double larger = uniform ? kUniformAgrees : kCurrentAgrees,
               smaller = uniform ? kUniformAgrees : kNoiseAgrees;
  std::vector<double> all;  // of each channel
  for (const auto& [channel, parts] : trial->channels) {
    const double alone = MedianOf(parts.factors);
    const bool as_others = uniform && alone < kUniform * together && together < kUniform * alone;
    const double factor = as_others ? together : uniform ? alone : LowerQuartileOf(parts.factors);
    ChannelNoise& c = noise.channels[channel];
    if (stated > 0 && std::isnan(c.stated)) c.stated = parts.size * first / tried;
    c.estimated = factor * parts.size;
    Choose(c, larger, smaller);
    all.push_back(tried * factor);
  }
  ChannelNoise common;
  common.stated = stated > 0 ? stated : std::nan("");
  common.estimated = MedianOf(all);
  Choose(common, larger, smaller);
  if (common.used != stated && std::isfinite(common.estimated)) noise.current_sample = common.used;
}

}  // namespace

double NoiseModel::Used(const std::string& channel) const {
  const auto it = channels.find(channel);
  return it == channels.end() ? std::numeric_limits<double>::quiet_NaN() : it->second.used;
}

double NoiseModel::RowsPerNumber(const std::string& channel) const {
  const auto it = channels.find(channel);
  return it == channels.end() ? 1 : it->second.rows_per_number;
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
  const auto quietest = QuietestErrors(model, model.measured(), *clean);
  std::map<std::string, double> white;
  for (const auto& [channel, parts] : direct) white[channel] = LowerQuartileOf(parts);
  const auto coloured = FilteredNoises(model, *clean, white);
  for (const auto& [channel, parts] : direct) {
    const auto least = quietest.find(channel);
    if (least == quietest.end()) continue;  // no row of it counts
    ChannelNoise& c = noise.channels[channel];
    const bool uniform = AreAlike(parts);
    // a model's error only adds to it
    c.estimated = uniform ? MedianOf(parts) : LowerQuartileOf(parts);
    // what is stated says nothing of noise that is plainly larger
    const bool unknown = !std::isfinite(c.stated) || c.estimated > kNoiseAgrees * c.stated;
    if (const auto whole = coloured.find(channel); whole != coloured.end() && unknown) {
      c.estimated = std::min(whole->second.rms, least->second);
      c.rows_per_number = whole->second.rows_per_number;
    }
    const double factor = uniform ? kUniformAgrees : kNoiseAgrees;
    // Filtered noise has less in its fastest differences than as a whole: it is as large as stated
    // where no record has a smaller error.
    const bool filtered = c.stated < kFilteredAgrees * least->second;
    Choose(c, factor, filtered ? kInfinity : factor);
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
                      : fmt::format("noise of {}: not stated, estimated from the records: {:.3g}{}",
                                    channel, c.estimated,
                                    c.rows_per_number > 1 ? " (filtered)" : ""));
  }
  return out;
}

}  // namespace ambrig
