#include "discovery/data/noise_spectrum.h"

#include <algorithm>
#include <cmath>

#include "discovery/data/stretch_lines.h"

namespace ambrig {

namespace {

// Squared coherence with the prediction from which an error is the model's; of 16 lines of noise 1
// % have as much.
constexpr double kCoherentError = 0.25;

}  // namespace

FilteredNoise NoiseOfStretches(const std::vector<ErrorStretch>& stretches, double white) {
  if (stretches.empty()) return {white, 1};
  std::vector<StretchLines> error, predicted;
  for (const ErrorStretch& s : stretches) {
    error.push_back(LinesOfStretch(s.error));
    predicted.push_back(LinesOfStretch(s.predicted));
  }
  double sum = 0, square = 0, lines = 0;
  for (const LineBand& octave : OctavesOf(error[0])) {
    const DensityRange densities = DensitiesOf(error, octave, static_cast<double>(octave.count()));
    const bool agree =
        LineCoherence(error, predicted, octave) < kCoherentError && densities.Agrees();
    const double density = agree ? densities.quarter : white * white;
    // what lies below the first octave is taken for as dense
    const auto covered = static_cast<double>(lines == 0 ? octave.to : octave.count());
    sum += covered * density;
    square += covered * density * density;
    lines += covered;
  }
  return {std::sqrt(sum / lines), std::max(1.0, lines * square / (sum * sum))};
}

}  // namespace ambrig
