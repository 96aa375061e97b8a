#include "discovery/search/residual_peaks.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/model/in_parallel.h"
#include "discovery/search/spectral_lines.h"

namespace ambrig {

namespace {

constexpr std::size_t kCoherentPeaks = 3, kSpectrumPeaks = 4, kLinesTried = 6;
// Least shares of the squared error above the noise that the lines of a tone hold: of all records
// of a free rotor, or of one reading in all of them. An error below the least excess, a share of
// the rows, counts as that.
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

/// Power of a plane's readings by frequency, the records added with their phases. `sums`: of each
/// target.
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

/// Squared error above the noise in some targets, and what the lines of each tone hold of it at
/// most (any phase in every target).
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

/// What the lines at f, 3f and 5f hold in one target of so many rows, less what noise puts there.
std::vector<double> LinesIn(const CaseModel& model, const std::vector<double>& residual,
                            const Target& t, double rows, const std::vector<double>& f) {
  std::vector<double> lines, held(f.size());
  for (const double order : {1.0, 3.0, 5.0})
    for (const double g : f) lines.push_back(order * g);
  const Sums sums = SumsAt(model, residual, t, lines);
  for (std::size_t k = 0; k < lines.size(); ++k)
    held[k % f.size()] += std::max(0.0, 2 * std::norm(sums[k]) / rows - 2);
  return held;
}

/// Whether tones of these frequencies may be in the records. Readings of a clamped rotor show a hum
/// as well.
std::vector<char> MayBeTones(const CaseModel& model, const std::vector<double>& residual,
                             const std::vector<double>& f) {
  const std::vector<Target>& targets = model.targets();
  std::vector<double> rows(targets.size());
  std::vector<std::vector<double>> lines(targets.size());
  InParallel(targets.size(), [&](std::size_t n) {
    rows[n] = CountedRows(model, targets[n]);
    if (rows[n] >= 1 && OverTime(model.data().records[targets[n].record]))
      lines[n] = LinesIn(model, residual, targets[n], rows[n], f);
  });
  LineShares all;  // of a free rotor
  std::map<std::string, LineShares> readings;
  for (std::size_t n = 0; n < targets.size(); ++n) {
    if (lines[n].empty()) continue;
    const CaseRecord& record = model.data().records[targets[n].record];
    const std::string& channel = record.data.channels[targets[n].channel].name;
    const double excess = rows[n] * (std::pow(TargetRatio(model, residual, targets[n]), 2) - 1);
    if (record.scenario.start != StartState::kClamped) all.Add(excess, rows[n], lines[n]);
    if (IsOfKind(channel, ChannelKind::kReading)) readings[channel].Add(excess, rows[n], lines[n]);
  }
  std::vector<char> out(f.size());
  for (std::size_t k = 0; k < f.size(); ++k)
    out[k] = all.Holds(k, kOfAll) || std::ranges::any_of(readings, [&](const auto& reading) {
               return reading.second.Holds(k, kOfReading);
             });
  return out;
}

/// Those of the strongest lines of every plane, and of the mains, that tones of the records may
/// have.
std::map<std::string, std::vector<double>> Tones(
    const CaseModel& model, const std::vector<double>& residual,
    const std::map<std::string, std::vector<double>>& strongest) {
  std::vector<double> all;
  for (const auto& [plane, lines] : strongest)
    for (const double f : WithMains(lines)) all.push_back(f);
  const std::vector<char> may_be = MayBeTones(model, residual, all);
  std::map<std::string, std::vector<double>> tones;
  std::size_t at = 0;
  for (const auto& [plane, lines] : strongest) {
    tones[plane];  // looked at
    for (const double f : WithMains(lines))
      if (may_be[at++]) tones[plane].push_back(f);
  }
  return tones;
}

/// Frequencies at which a tone of one phase in all records is looked for: a grid where most of them
/// are, which stands as close as the lines of records of 2 s are wide, and round the strongest
/// lines that it does not reach.
std::vector<double> TonesLookedAt(const CaseModel& model, const std::vector<double>& residual) {
  constexpr double kGridBegins = 8, kGridEnds = 320, kStep = 0.4, kAllReached = 2;  // [Hz], [s]
  constexpr int kBeside = 6;  // on either side of a line, over its width
  std::vector<double> f;
  for (double g = kGridBegins; g < kGridEnds; g += kStep) f.push_back(g);
  std::vector<std::size_t> readings;
  for (std::size_t n = 0; n < model.targets().size(); ++n)
    if (IsReading(model, model.targets()[n])) readings.push_back(n);
  const double longest = LongestRecord(model, readings);
  const double from = longest > kAllReached ? 2 / longest : kGridEnds;
  for (const double line : StrongestLines(model, residual, readings, {from, kLinesTried}))
    for (int k = -kBeside; k <= kBeside; ++k) f.push_back(line + k / (kBeside * longest));
  std::ranges::sort(f);
  f.erase(std::ranges::unique(f).begin(), f.end());
  return f;
}

/// Frequencies of the points of responses with the largest errors, which a resonance may be
/// narrower than the lines of.
std::vector<double> PeaksOfResponses(const CaseModel& model, const std::vector<double>& residual) {
  constexpr double kSeen = 9;  // squared error of a response's point, real and imaginary part
  constexpr std::size_t kPoints = 4;
  std::map<std::pair<std::size_t, std::size_t>, double>
      errors;  // of a record's point, largest response
  for (const Target& t : model.targets())
    if (model.data().records[t.record].kind == RecordKind::kFrf)
      for (std::size_t k = t.first; k < t.first + t.count; ++k) {
        double& error = errors[{t.record, model.sample(k)}];
        error = std::max(error, residual[k] * residual[k]);
      }
  std::vector<std::pair<double, double>> points;  // error, frequency
  for (const auto& [point, error] : errors)
    if (error > kSeen)
      points.emplace_back(error,
                          model.data().records[point.first].responses.frequency[point.second]);
  std::ranges::stable_sort(points, std::greater{}, &std::pair<double, double>::first);
  std::vector<double> out;
  for (const auto& [error, f] : points)
    if (out.size() < kPoints) AppendApart(out, {f}, 0.02);
  return out;
}

}  // namespace

void AppendApart(std::vector<double>& list, const std::vector<double>& more, double ratio) {
  for (double f : more)
    if (std::none_of(list.begin(), list.end(),
                     [&](double g) { return std::abs(std::log(f / g)) < ratio; }))
      list.push_back(f);
}

std::vector<double> WithMains(std::vector<double> frequencies) {
  AppendApart(frequencies, {50, 60}, 0.01);
  return frequencies;
}

ResidualPeaks FindPeaks(const CaseModel& model, const std::vector<double>& residual) {
  std::vector<double> wide;
  const std::vector<double> f = TonesLookedAt(model, residual);
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
  peaks.tones = Tones(model, residual, peaks.coherent);
  for (std::size_t n = 0; n < any_phase.size(); ++n)
    for (std::size_t k = 0; k < any_phase[n].size(); ++k)
      power[k] += std::norm(any_phase[n][k]) / static_cast<double>(model.targets()[n].count);
  peaks.spectrum = PeaksOfResponses(model, residual);
  AppendApart(peaks.spectrum, Peaks(wide, power, kSpectrumPeaks, 0.1), 0.02);
  return peaks;
}

}  // namespace ambrig
