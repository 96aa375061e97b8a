#include "app/figures/residual_data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/record/channels.h"
#include "discovery/model/floor.h"

namespace ambrig {

std::string ShortName(const std::string& data_file) {
  const std::string name = data_file.substr(data_file.find_last_of('/') + 1);
  return name.substr(0, name.find_last_of('.'));
}

const std::string& ChannelName(const CaseModel& model, const Target& t) {
  return model.data().records[t.record].data.channels[t.channel].name;
}

ChannelView ViewOf(const CaseModel& model, const std::vector<double>& predicted, const Target& t) {
  const CaseRecord& record = model.data().records[t.record];
  ChannelView v;
  v.channel = ChannelName(model, t);
  v.record = ShortName(record.data_file);
  v.rate = record.data.rate;
  v.floor = t.floor;
  for (std::size_t k = t.first; k < t.first + t.count; ++k) {
    const bool ok = model.ok()[k] != 0;
    v.t.push_back(record.data.TimeAt(k - t.first));
    v.measured.push_back(ok ? model.measured()[k] : std::nan(""));
    v.model.push_back(predicted[k]);
    v.residual.push_back(v.measured.back() - predicted[k]);
  }
  return v;
}

std::vector<Target> WorstTargets(const CaseModel& model, const std::vector<double>& residual,
                                 std::size_t record, std::size_t count, std::size_t per_kind) {
  std::vector<std::pair<double, const Target*>> all;
  for (const Target& t : model.targets())
    if (t.record == record) all.emplace_back(TargetRatio(model, residual, t), &t);
  std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Target> out;
  std::map<std::string_view, std::size_t> kinds;
  for (const auto& [ratio, t] : all) {
    if (out.size() == count || (ratio < 1.05 && !out.empty())) break;
    if (++kinds[ChannelWords(ChannelName(model, *t))] <= per_kind) out.push_back(*t);
  }
  return out;
}

namespace {

double Rms(const std::vector<double>& v, const Target& t) {
  double sum = 0;
  for (std::size_t k = t.first; k < t.first + t.count; ++k) sum += v[k] * v[k];
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, t.count)));
}

}  // namespace

std::vector<double> NoiseSample(const CaseModel& model, const Hypothesis& h,
                                const std::vector<double>& clean) {
  Hypothesis noisy = h;
  noisy.rig = WithNoise(h.rig, model.noise_model);
  auto sample = model.PredictNoisy(noisy, 13);
  if (!sample) return {};
  std::vector<double>& n = *sample;
  for (std::size_t k = 0; k < n.size(); ++k) n[k] -= clean[k];
  std::mt19937_64 generator(13);
  std::normal_distribution<double> white;
  for (const Target& t : model.targets()) {
    const double rms = Rms(n, t);
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      n[k] = rms > 0 ? n[k] * t.floor / rms : t.floor * white(generator);
  }
  return n;
}

std::vector<double> Filled(const std::vector<double>& x) {
  std::vector<double> out(x);
  for (double& v : out)
    if (!std::isfinite(v)) v = 0;
  return out;
}

std::vector<double> Autocorrelation(const std::vector<double>& x, std::size_t count) {
  const std::vector<double> y = Filled(x);
  std::vector<double> out(std::min(count, y.size()), 0);
  for (std::size_t lag = 0; lag < out.size(); ++lag)
    for (std::size_t k = 0; k + lag < y.size(); ++k) out[lag] += y[k] * y[k + lag];
  const double power = out.empty() ? 0 : out[0];
  for (double& v : out) v = power > 0 ? v / power : 0;
  return out;
}

}  // namespace ambrig
