#include "simulation/commissioning/excess_scatter.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

constexpr std::size_t kBins = 6;
constexpr std::size_t kSettle = 200, kEvery = 10;  // periods

struct Seen {
  double at = 0, c = 0;
};

ExcessScatter Binned(const std::string& quantity, const std::string& unit,
                     const std::vector<Seen>& seen) {
  ExcessScatter out{quantity, unit, {}};
  double most = 0;
  for (const Seen& s : seen) most = std::max(most, s.at);
  if (!(most > 0)) return out;
  const double width = most / kBins;
  for (std::size_t b = 0; b < kBins; ++b)
    out.bins.push_back(
        {width * static_cast<double>(b), width * static_cast<double>(b + 1), 0, 0, 0});
  for (const Seen& s : seen) {
    auto& bin = out.bins[std::min(kBins - 1, static_cast<std::size_t>(s.at / width))];
    bin.rms += s.c * s.c;
    bin.largest = std::max(bin.largest, std::abs(s.c));
    ++bin.periods;
  }
  for (auto& bin : out.bins)
    if (bin.periods > 0) bin.rms = std::sqrt(bin.rms / static_cast<double>(bin.periods));
  return out;
}

}  // namespace

std::vector<ExcessScatter> ScatterOf(const CoilDetectorSetup& setup, const CommissioningLog& log,
                                     const CommissionedBearing& bearing) {
  CommissionedBearing open = bearing;  // without a range: every period counts
  for (double& v : open.largest_flux.v) v = kInfinity;
  CommissionedDetector detector(setup, open);
  std::vector<Seen> displacement, velocity, current;
  const double T = setup.settings.sampling.step * setup.settings.sampling.samples;
  for (std::size_t n = 0; n < log.size(); ++n) {
    const MeasuredPeriod in = log.At(n);
    detector.Watch(in);
    if (n < kSettle || n % kEvery != 0) continue;
    const Lane c = detector.Excess(2);
    for (int j = 0; j < setup.model.coils; ++j) {
      displacement.push_back({std::hypot(in.x1, in.y1), c[j]});
      velocity.push_back({std::hypot(in.x1 - in.x0, in.y1 - in.y0) / T, c[j]});
      current.push_back({detector.period().largest[j], c[j]});
    }
  }
  return {Binned("displacement", "m", displacement), Binned("velocity", "m/s", velocity),
          Binned("current", "A", current)};
}

}  // namespace ambrig
