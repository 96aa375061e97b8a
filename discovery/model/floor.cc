#include "discovery/model/floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/record/channels.h"
#include "discovery/model/in_parallel.h"
#include "discovery/model/point_floor.h"
#include "discovery/model/residual.h"
#include "rig/clearance.h"

namespace ambrig {

namespace {

double Rms(const std::vector<double>& v, std::size_t first, std::size_t count) {
  double sum = 0;
  for (std::size_t k = first; k < first + count; ++k) sum += v[k] * v[k];
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

/// rms over the rows that count; rows behind a record's horizon are zero in all predictions.
double CountedRms(const CaseModel& model, const std::vector<double>& v, const Target& t) {
  double sum = 0, n = 0;
  for (std::size_t k = t.first; k < t.first + t.count; ++k)
    if (model.ok()[k]) sum += v[k] * v[k], n += 1;
  return n > 0 ? std::sqrt(sum / n) : Rms(v, t.first, t.count);
}

/// Least that an error of this channel can mean: a step of its converter, or the file's rounding.
double Resolution(const RigParameters& rig, const ChannelRow& channel, double full_scale) {
  using Range = ChannelResolution::Range;
  const ChannelResolution& r = channel.resolution;
  const double range = r.range == Range::kAdc          ? rig.amplifier.adc_range
                       : r.range == Range::kBusVoltage ? rig.amplifier.bus_voltage
                       : r.range == Range::kSignal     ? full_scale
                                                       : 0;
  return std::max(r.least, r.part * range);
}

/// Σ ρ² of one channel with all of its record, whose rms are given.
double SumOfSquaredCorrelations(const std::vector<double>& noise,
                                const std::vector<const Target*>& of,
                                const std::vector<double>& rms, std::size_t one) {
  const Target& a = *of[one];
  double sum = 0;
  for (std::size_t other = 0; other < of.size(); ++other) {
    const Target& b = *of[other];
    double c = 0;
    for (std::size_t k = 0; k < a.count; ++k) c += noise[a.first + k] * noise[b.first + k];
    const double rho = rms[one] > 0 && rms[other] > 0
                           ? c / static_cast<double>(a.count) / rms[one] / rms[other]
                           : (one == other ? 1.0 : 0.0);
    sum += rho * rho;
  }
  return sum;
}

/// Independent rows times independent channels of one record: the latter from the spread of their
/// correlations. `of`: its targets; `noise`: of one noisy run.
double IndependentNumbers(const CaseModel& model, const std::vector<const Target*>& of,
                          const std::vector<double>& noise) {
  if (!OverTime(model.data().records[of[0]->record]))  // every point was measured by itself
    return std::accumulate(of.begin(), of.end(), 0.0, [&](double sum, const Target* t) {
      return sum + CountedRows(model, *t);
    });
  std::vector<double> rms, independent(of.size()), square(of.size());
  for (const Target* t : of) rms.push_back(Rms(noise, t->first, t->count));
  InParallel(of.size(), [&](std::size_t a) {
    const Target& t = *of[a];
    const CaseRecord& record = model.data().records[t.record];
    independent[a] =
        static_cast<double>(t.count) /
        std::max(RowsPerIndependentOne(noise, t.first, t.count),
                 model.noise_model.RowsPerNumber(record.data.channels[t.channel].name));
    square[a] = SumOfSquaredCorrelations(noise, of, rms, a);
  });
  const double per_channel = std::accumulate(independent.begin(), independent.end(), 0.0) /
                             static_cast<double>(of.size()),
               spread = std::accumulate(square.begin(), square.end(), 0.0);
  return per_channel * static_cast<double>(of.size() * of.size()) / spread;
}

/// Of all records; each target learns what a row of its record is worth.
double IndependentRows(CaseModel& model, const std::vector<double>& noise) {
  double all = 0;
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    std::vector<const Target*> of;
    double rows = 0;
    for (const Target& t : model.targets())
      if (t.record == r) of.push_back(&t), rows += static_cast<double>(t.count);
    if (of.empty()) continue;
    const double numbers = IndependentNumbers(model, of, noise);
    all += numbers;
    for (Target& t : model.targets())
      if (t.record == r) t.independent = std::min(1.0, numbers / rows);
  }
  return all;
}

}  // namespace

double RowsPerIndependentOne(const std::vector<double>& v, std::size_t first, std::size_t count) {
  const double power = std::pow(Rms(v, first, count), 2);
  if (power <= 0) return 1;
  double sum = 1;
  const std::size_t lags = std::min<std::size_t>(200, count / 4);
  for (std::size_t lag = 1; lag < lags; ++lag) {
    const auto pairs = static_cast<Eigen::Index>(count - lag);
    const double c = Eigen::Map<const Eigen::VectorXd>(v.data() + first, pairs)
                         .dot(Eigen::Map<const Eigen::VectorXd>(v.data() + first + lag, pairs));
    const double rho = c / static_cast<double>(pairs) / power;
    sum += 2 * rho * rho;
  }
  return sum;
}

NoiseFloor FindFloor(CaseModel& model, const Hypothesis& h) {
  NoiseFloor floor;
  Hypothesis noisy = h;
  noisy.rig = WithNoise(h.rig, model.noise_model);
  std::array<std::optional<std::vector<double>>, 3> runs;
  InParallel(runs.size(), [&](std::size_t k) {
    runs[k] = k == 0 ? model.Predict(h) : model.PredictNoisy(noisy, 10 + k);
  });
  const auto& [clean, first, second] = runs;
  if (!clean) throw InputError(model.data().file + ": the model loses levitation in these records");
  std::vector<double> d1(clean->size()), d2(clean->size());
  for (std::size_t k = 0; k < d1.size(); ++k) {
    // where noise alone drops the rotor, the stated noise of each channel is all that is known
    d1[k] = first ? (*first)[k] - (*clean)[k] : second ? (*second)[k] - (*clean)[k] : 0;
    d2[k] = second ? (*second)[k] - (*clean)[k] : d1[k];
  }
  floor.unpredictable = UnpredictableRows(model, d1, d2);
  model.LeaveOut(floor.unpredictable);
  for (std::size_t n = 0; n < model.targets().size(); ++n) {
    Target& t = model.targets()[n];
    const CaseRecord& record = model.data().records[t.record];
    if (!OverTime(record)) {
      t.floor = PointFloor(model, n, *clean);
      continue;
    }
    const std::string& channel = record.data.channels[t.channel].name;
    const auto id = ParseChannel(channel);
    Require(id.has_value(), "targets are channels of the rig");
    const double a = CountedRms(model, d1, t), b = CountedRms(model, d2, t);
    double square = 0.5 * (a * a + b * b);
    // load cells: noise of their own
    const bool reader_noise = id->kind == ChannelKind::kLoadCell;
    // A current's noise is that of the runs, which differs from record to record: of one reading,
    // or of the mean of many.
    const bool of_runs =
        id->kind == ChannelKind::kCoilCurrent && !model.data().noise.contains(channel);
    if (const double used = model.noise_model.Used(channel); std::isfinite(used) && !of_runs)
      square = reader_noise ? square + used * used : std::max(square, used * used);
    t.floor = std::sqrt(square);
    // what is stated of a channel holds, but for the step of a converter
    const bool converted = id->row().resolution.range == ChannelResolution::Range::kAdc;
    if (square > 0 && !converted && model.data().noise.contains(channel)) continue;
    // of positions in a wrong unit the signal says nothing about what the file rounds
    const double full_scale = std::min(t.full_scale, GapOfAxis(h.rig, channel));
    t.floor = std::max(t.floor, Resolution(h.rig, id->row(), full_scale));
  }
  floor.effective_sample_size = IndependentRows(model, d1);
  floor.clean = *clean;
  return floor;
}

}  // namespace ambrig
