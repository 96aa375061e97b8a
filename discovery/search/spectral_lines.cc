#include "discovery/search/spectral_lines.h"

#include <algorithm>
#include <cmath>

#include "core/math/fft.h"
#include "discovery/model/in_parallel.h"

namespace ambrig {

namespace {

constexpr double kHighestLine = 0.4;    // of the sampling rate
constexpr double kLinesApart = 0.01;    // of their frequency
constexpr std::size_t kBesideLine = 4;  // cells: two widths of a line
constexpr double kLineOverRest = 3;     // of the power

/// A length that transforms quickly: a power of two, at least twice the rows.
std::size_t PaddedLength(std::size_t rows) {
  std::size_t n = 2;
  while (n < 2 * rows) n *= 2;
  return n;
}

}  // namespace

double LongestRecord(const CaseModel& model, const std::vector<std::size_t>& targets) {
  double longest = 0;
  for (const std::size_t n : targets) {
    const Target& t = model.targets()[n];
    const double rate = model.data().records[t.record].data.rate;
    longest = std::max(longest, static_cast<double>(t.count) / rate);
  }
  return longest;
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

std::vector<double> StrongestLines(const CaseModel& model, const std::vector<double>& residual,
                                   const std::vector<std::size_t>& targets, const LineBand& band) {
  std::vector<std::vector<std::complex<double>>> spectra(targets.size());
  InParallel(targets.size(), [&](std::size_t k) {
    const Target& t = model.targets()[targets[k]];
    std::vector<double> padded(PaddedLength(t.count));
    std::copy_n(residual.begin() + static_cast<std::ptrdiff_t>(t.first), t.count, padded.begin());
    spectra[k] = RealFft(padded);
  });
  const double longest = LongestRecord(model, targets);
  if (!(longest > 0)) return {};
  std::vector<double> f, power;  // half the width of a line apart
  const auto cell_of = [&](double frequency) {
    return static_cast<std::size_t>(std::lround(2 * longest * (frequency - band.from)));
  };
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const Target& t = model.targets()[targets[k]];
    const double rate = model.data().records[t.record].data.rate,
                 step = 0.5 * rate / static_cast<double>(spectra[k].size() - 1);
    if (kHighestLine * rate <= band.from) continue;
    const std::size_t cells = cell_of(kHighestLine * rate) + 1;
    if (power.size() < cells) power.resize(cells);
    std::vector<double> own(cells);
    for (std::size_t line = 0; line < spectra[k].size(); ++line) {
      const double frequency = static_cast<double>(line) * step;
      if (frequency < band.from || frequency > kHighestLine * rate) continue;
      double& cell = own[cell_of(frequency)];
      cell = std::max(cell, std::norm(spectra[k][line]) / static_cast<double>(t.count));
    }
    for (std::size_t c = 0; c < cells; ++c) power[c] += own[c];
  }
  // A line stands out of what is beside it; a smooth spectrum has none.
  std::vector<double> lines(power.size());
  for (std::size_t c = 0; c < power.size(); ++c) {
    f.push_back(band.from + static_cast<double>(c) / (2 * longest));
    const bool inside = c >= kBesideLine && c + kBesideLine < power.size();
    if (inside &&
        power[c] > kLineOverRest * std::max(power[c - kBesideLine], power[c + kBesideLine]))
      lines[c] = power[c];
  }
  std::vector<double> out = Peaks(f, lines, band.count, kLinesApart);
  std::erase_if(out, [&](double g) { return lines[cell_of(g)] == 0; });
  return out;
}

}  // namespace ambrig
