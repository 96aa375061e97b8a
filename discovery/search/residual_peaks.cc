#include "discovery/search/residual_peaks.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/model/in_parallel.h"

namespace ambrig {

namespace {

constexpr std::size_t kCoherentPeaks = 3, kSpectrumPeaks = 4;
// Least shares of the squared error above the noise that the lines of a tone hold: of all records of a free rotor, or
// of one reading in all of them. An error below the least excess, a share of the rows, counts as that.
constexpr double kOfAll = 0.05, kOfReading = 0.2, kLeastExcess = 0.05;

bool IsReading(const CaseModel& model, const Target& t) {
  const CaseRecord& record = model.data().records[t.record];
  const auto id = ParseChannel(record.data.channels[t.channel].name);
  return record.scenario.start != StartState::kClamped && id && id->kind == ChannelKind::kReading &&
         !id->plane.empty();
}

using Sums = std::vector<std::complex<double>>;

/// Fourier sums of one target's residual at frequencies f, phase zero at the scenario's start.
Sums SumsAt(const CaseModel& model, const std::vector<double>& residual, const Target& t,
            const std::vector<double>& f) {
  // Some at a time: every phase waits for the one before.
  constexpr Eigen::Index kTogether = 16;
  using Lanes = Eigen::Array<double, kTogether, 1>;
  const CaseRecord& record = model.data().records[t.record];
  const auto residuals = std::span(residual).subspan(t.first, t.count);
  Sums out(f.size());
  for (std::size_t first = 0; first < f.size(); first += kTogether) {
    const std::size_t count = std::min<std::size_t>(kTogether, f.size() - first);
    Lanes frequency = Lanes::Zero();
    for (std::size_t k = 0; k < count; ++k) frequency[static_cast<Eigen::Index>(k)] = f[first + k];
    const Lanes turn = frequency * (-2 * kPi / record.data.rate),
                start = frequency * (-2 * kPi * record.data.start), c = turn.cos(), s = turn.sin();
    Lanes re = start.cos(), im = start.sin(), sum_re = Lanes::Zero(), sum_im = Lanes::Zero();
    for (const double r : residuals) {
      sum_re += r * re;
      sum_im += r * im;
      const Lanes next = re * c - im * s;
      im = re * s + im * c;
      re = next;
    }
    for (std::size_t k = 0; k < count; ++k)
      if (const auto lane = static_cast<Eigen::Index>(k); - turn[lane] <= 0.8 * kPi)
        out[first + k] = {sum_re[lane], sum_im[lane]};
  }
  return out;
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

/// Power of a plane's readings by frequency, the records added with their phases. `sums`: of each target.
std::vector<double> CoherentPower(const CaseModel& model, const std::vector<Sums>& sums,
                                  const std::string& plane, std::size_t frequencies) {
  std::map<std::string, Sums> channels;
  for (std::size_t n = 0; n < sums.size(); ++n) {
    if (sums[n].empty()) continue;
    const Target& t = model.targets()[n];
    const std::string& channel = model.data().records[t.record].data.channels[t.channel].name;
    if (ParseChannel(channel)->plane != plane) continue;
    Sums& sum = channels.try_emplace(channel, frequencies).first->second;
    for (std::size_t k = 0; k < frequencies; ++k) sum[k] += sums[n][k];
  }
  std::vector<double> power(frequencies);
  for (const auto& [channel, sum] : channels)
    for (std::size_t k = 0; k < frequencies; ++k) power[k] += std::norm(sum[k]);
  return power;
}

/// Squared error above the noise in some targets, and what the lines of each tone hold of it at most (any phase in
/// every target).
struct LineShares {
  double excess = 0, rows = 0;
  std::vector<double> held;

  void Add(double more_excess, double more_rows, const std::vector<double>& more) {
    excess += more_excess;
    rows += more_rows;
    held.resize(more.size());
    for (std::size_t k = 0; k < more.size(); ++k) held[k] += more[k];
  }
  bool Holds(std::size_t tone, double share) const {
    return !held.empty() && held[tone] > share * std::max(excess, kLeastExcess * rows);
  }
};

/// What the lines at f, 3f and 5f hold in one target, less what noise puts there.
std::vector<double> LinesIn(const CaseModel& model, const std::vector<double>& residual,
                            const Target& t, const std::vector<double>& f) {
  std::vector<double> held(f.size());
  const double rows = CountedRows(model, t);
  if (rows < 1) return held;
  for (const double order : {1.0, 3.0, 5.0}) {
    std::vector<double> line = f;
    for (double& g : line) g *= order;
    const Sums sums = SumsAt(model, residual, t, line);
    for (std::size_t k = 0; k < f.size(); ++k)
      held[k] += std::max(0.0, 2 * std::norm(sums[k]) / rows - 2);
  }
  return held;
}

/// Those of the frequencies f that tones of the records may have. Readings of a clamped rotor show a hum as well.
std::vector<double> TonesAmong(const CaseModel& model, const std::vector<double>& residual,
                               const std::vector<double>& f) {
  const std::vector<Target>& targets = model.targets();
  std::vector<std::vector<double>> lines(targets.size());
  InParallel(targets.size(), [&](std::size_t n) {
    if (OverTime(model.data().records[targets[n].record]))
      lines[n] = LinesIn(model, residual, targets[n], f);
  });
  std::vector<LineShares> parts(1);  // all of a free rotor, then each reading
  std::map<std::string, std::size_t> readings;
  for (std::size_t n = 0; n < targets.size(); ++n) {
    if (lines[n].empty()) continue;
    const Target& t = targets[n];
    const CaseRecord& record = model.data().records[t.record];
    const std::string& channel = record.data.channels[t.channel].name;
    const double rows = CountedRows(model, t);
    double excess = -rows;
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      if (model.ok()[k]) excess += residual[k] * residual[k];
    if (record.scenario.start != StartState::kClamped) parts[0].Add(excess, rows, lines[n]);
    if (!IsOfKind(channel, ChannelKind::kReading)) continue;
    const auto [place, fresh] = readings.try_emplace(channel, parts.size());
    if (fresh) parts.emplace_back();
    parts[place->second].Add(excess, rows, lines[n]);
  }
  std::vector<double> out;
  for (std::size_t k = 0; k < f.size(); ++k)
    if (std::any_of(parts.begin(), parts.end(), [&](const LineShares& part) {
          return part.Holds(k, &part == parts.data() ? kOfAll : kOfReading);
        }))
      out.push_back(f[k]);
  return out;
}

}  // namespace

std::vector<double> WithMains(std::vector<double> frequencies) {
  for (const double mains : {50.0, 60.0})
    if (std::none_of(frequencies.begin(), frequencies.end(),
                     [&](double f) { return std::abs(std::log(mains / f)) < 0.01; }))
      frequencies.push_back(mains);
  return frequencies;
}

ResidualPeaks FindPeaks(const CaseModel& model, const std::vector<double>& residual) {
  std::vector<double> f, wide;
  for (double g = 8; g < 320; g += 0.4) f.push_back(g);
  for (double g = 15; g < 2500; g *= 1.012) wide.push_back(g);
  // of each target that is a reading
  std::vector<Sums> coherent(model.targets().size()), any_phase(model.targets().size());
  InParallel(model.targets().size(), [&](std::size_t n) {
    const Target& t = model.targets()[n];
    if (!IsReading(model, t)) return;
    coherent[n] = SumsAt(model, residual, t, f);
    any_phase[n] = SumsAt(model, residual, t, wide);
  });
  ResidualPeaks peaks;
  std::vector<double> all(f.size()), power(wide.size());
  for (const auto& b : model.data().rig.bearings) {
    const std::vector<double> of_plane = CoherentPower(model, coherent, b.name, f.size());
    peaks.coherent[b.name] = Peaks(f, of_plane, kCoherentPeaks, 0.04);
    for (std::size_t k = 0; k < f.size(); ++k) all[k] += of_plane[k];
  }
  peaks.coherent["rig"] = Peaks(f, all, kCoherentPeaks, 0.04);
  for (const auto& [plane, strongest] : peaks.coherent)
    peaks.tones[plane] = TonesAmong(model, residual, WithMains(strongest));
  for (std::size_t n = 0; n < any_phase.size(); ++n)
    for (std::size_t k = 0; k < any_phase[n].size(); ++k)
      power[k] += std::norm(any_phase[n][k]) / static_cast<double>(model.targets()[n].count);
  peaks.spectrum = Peaks(wide, power, kSpectrumPeaks, 0.1);
  return peaks;
}

}  // namespace ambrig
