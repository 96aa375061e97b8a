#pragma once
/// Noise that is not white, from the spectra of short stretches of an error. Amplifiers and
/// anti-aliasing filters leave little of a noise in the fastest differences (noise_estimate.h); a
/// spectrum holds all of it.
#include <vector>

namespace ambrig {

struct FilteredNoise {
  double rms = 0;              // [unit of the error]
  double rows_per_number = 1;  // rows that are worth one independent number
};

/// A stretch of rows that follow each other.
struct ErrorStretch {
  std::vector<double> error, predicted;  // measured minus predicted; what was predicted
};

/// `stretches`: of equal length, a power of two; `white`: rms of the white noise in them.
/// Noise has the same density in every stretch, what a model lacks is where the rig is driven: of
/// each octave the density that a quarter of the stretches stay below counts, corrected for its
/// scatter, where the middle half of them agrees and the error is not coherent with the prediction;
/// elsewhere the white noise. Lines spoil one octave of few stretches. No stretches: the white
/// noise. Source: P. D. Welch, IEEE Trans. Audio Electroacoust. 15 (1967).
FilteredNoise NoiseOfStretches(const std::vector<ErrorStretch>& stretches, double white);

}  // namespace ambrig
