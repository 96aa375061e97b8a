#include "discovery/data/stationary_noise.h"

#include <algorithm>
#include <cmath>

#include "discovery/data/noise_estimate.h"
#include "discovery/data/stretch_lines.h"

namespace ambrig {

namespace {

constexpr double kDrivenApart = 3;         // strongest tenth over the weakest one
constexpr double kCounts = 0.05;           // of the power, of an octave
constexpr double kChance = 0.01;           // of a coherence as large, of all channels
constexpr double kOfUnexpected = 1.0 / 3;  // of the power
constexpr double kLine = 1.0 / 7;          // of an octave's power, of one line
constexpr double kComesAndGoes = 0.35;     // variance of a line's power over its mean square

double RmsAboutMean(const std::vector<double>& x) {
  double sum = 0, square = 0;
  for (const double v : x) sum += v, square += v * v;
  const auto n = static_cast<double>(x.size());
  return std::sqrt(std::max(0.0, square / n - sum / n * sum / n));
}

bool DrivenApart(const std::vector<DrivenStretch>& stretches) {
  std::vector<double> motion;
  for (const DrivenStretch& s : stretches) motion.push_back(RmsAboutMean(s.predicted[0]));
  return QuantileOf(motion, 0.9) > kDrivenApart * QuantileOf(motion, 0.1);
}

/// Lines of every prediction in all stretches.
std::vector<std::vector<StretchLines>> LinesOfPredictions(
    const std::vector<DrivenStretch>& stretches) {
  std::vector<std::vector<StretchLines>> out(stretches[0].predicted.size());
  for (const DrivenStretch& s : stretches)
    for (std::size_t p = 0; p < out.size(); ++p) out[p].push_back(LinesOfStretch(s.predicted[p]));
  return out;
}

bool FollowsPrediction(const std::vector<StretchLines>& error,
                       const std::vector<std::vector<StretchLines>>& predicted,
                       const LineBand& octave, double unexpected) {
  const auto numbers = static_cast<double>(error.size() * octave.count());
  const double chance = std::log(static_cast<double>(predicted.size()) / kChance) / numbers;
  const double most = std::max(chance, kOfUnexpected * unexpected);
  return std::any_of(predicted.begin(), predicted.end(),
                     [&](const auto& lines) { return LineCoherence(error, lines, octave) > most; });
}

/// Whether some line of the octave stands still: the power of noise in it would come and go.
bool HasLine(const std::vector<LinePower>& powers) {
  double all = 0;
  for (const LinePower& line : powers) all += line.mean;
  return std::ranges::any_of(powers, [&](const LinePower& line) {
    return line.mean > kLine * all && line.variance < kComesAndGoes * line.mean * line.mean;
  });
}

}  // namespace

std::optional<StationaryNoise> StationaryNoiseOf(const std::vector<DrivenStretch>& stretches,
                                                 double expected) {
  if (stretches.size() < kFewestOfNoise || !DrivenApart(stretches)) return {};
  std::vector<StretchLines> error;
  double square = 0;
  for (const DrivenStretch& s : stretches) {
    error.push_back(LinesOfStretch(s.error));
    for (const double e : s.error) square += e * e / static_cast<double>(s.error.size());
  }
  square /= static_cast<double>(stretches.size());
  const double unexpected = std::max(0.0, 1 - expected * expected / square);
  const std::vector<std::vector<StretchLines>> predicted = LinesOfPredictions(stretches);
  const std::vector<LineBand> octaves = OctavesOf(error[0]);
  const auto lines = static_cast<double>(error[0].size() - 1);
  StationaryNoise out;
  double most = 0;
  for (const LineBand& octave : octaves) {
    const std::vector<LinePower> powers = PowersOf(error, octave);
    const DensityRange densities = DensitiesOf(error, octave, IndependentLines(powers));
    const double power = static_cast<double>(octave.count()) / lines * densities.three_quarters;
    if (power < kCounts * square) continue;
    if (!densities.Agrees() || FollowsPrediction(error, predicted, octave, unexpected) ||
        HasLine(powers))
      return {};
    if (power <= most) continue;
    most = power;
    out.middle = 0.5 * static_cast<double>(octave.from + octave.to) /
                 static_cast<double>(stretches[0].error.size());
  }
  out.rms = std::sqrt(square);
  return out;
}

}  // namespace ambrig
