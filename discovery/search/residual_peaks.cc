#include "discovery/search/residual_peaks.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/math/constants.h"
#include "core/record/channels.h"

namespace ambrig {

namespace {

constexpr std::size_t kCoherentPeaks = 3, kSpectrumPeaks = 4;

bool IsReading(const CaseModel& model, const Target& t) {
  const CaseRecord& record = model.data().records[t.record];
  const auto id = ParseChannel(record.data.channels[t.channel].name);
  return record.scenario.start != StartState::kClamped && id && id->kind == ChannelKind::kReading &&
         !id->plane.empty();
}

/// Fourier sum of one target's residual at f, phase zero at the scenario's start.
std::complex<double> SumAt(const CaseModel& model, const std::vector<double>& residual,
                           const Target& t, double f) {
  const CaseRecord& record = model.data().records[t.record];
  const double w = 2 * kPi * f / record.data.rate;
  if (w > 0.8 * kPi) return 0;
  const std::complex<double> turn = std::polar(1.0, -w);
  std::complex<double> phase = std::polar(1.0, -2 * kPi * f * record.data.start), sum = 0;
  for (std::size_t k = t.first; k < t.first + t.count; ++k) {
    sum += residual[k] * phase;
    phase *= turn;
  }
  return sum;
}

std::vector<double> Peaks(const std::vector<double>& f, const std::vector<double>& power,
                          std::size_t count, double apart) {
  std::vector<std::size_t> order;
  for (std::size_t k = 1; k + 1 < f.size(); ++k)
    if (power[k] >= power[k - 1] && power[k] >= power[k + 1]) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
  std::vector<double> out;
  for (std::size_t k : order) {
    if (out.size() >= count) break;
    if (std::none_of(out.begin(), out.end(),
                     [&](double g) { return std::abs(f[k] - g) < apart * g; }))
      out.push_back(f[k]);
  }
  return out;
}

/// Power of a plane's readings by frequency, the records added with their phases.
std::vector<double> CoherentPower(const CaseModel& model, const std::vector<double>& residual,
                                  const std::string& plane, const std::vector<double>& f) {
  std::vector<double> power(f.size());
  for (std::size_t k = 0; k < f.size(); ++k) {
    std::map<std::string, std::complex<double>> sums;
    for (const Target& t : model.targets()) {
      if (!IsReading(model, t)) continue;
      const std::string& channel = model.data().records[t.record].data.channels[t.channel].name;
      if (ParseChannel(channel)->plane == plane) sums[channel] += SumAt(model, residual, t, f[k]);
    }
    for (const auto& [channel, sum] : sums) power[k] += std::norm(sum);
  }
  return power;
}

}  // namespace

ResidualPeaks FindPeaks(const CaseModel& model, const std::vector<double>& residual) {
  ResidualPeaks peaks;
  std::vector<double> f, all;
  for (double g = 8; g < 320; g += 0.4) f.push_back(g);
  all.assign(f.size(), 0);
  for (const auto& b : model.data().rig.bearings) {
    const std::vector<double> power = CoherentPower(model, residual, b.name, f);
    peaks.coherent[b.name] = Peaks(f, power, kCoherentPeaks, 0.04);
    for (std::size_t k = 0; k < f.size(); ++k) all[k] += power[k];
  }
  peaks.coherent["rig"] = Peaks(f, all, kCoherentPeaks, 0.04);
  std::vector<double> wide, power;
  for (double g = 15; g < 2500; g *= 1.012) {
    wide.push_back(g);
    power.push_back(0);
    for (const Target& t : model.targets())
      if (IsReading(model, t))
        power.back() += std::norm(SumAt(model, residual, t, g)) / static_cast<double>(t.count);
  }
  peaks.spectrum = Peaks(wide, power, kSpectrumPeaks, 0.1);
  return peaks;
}

}  // namespace ambrig
