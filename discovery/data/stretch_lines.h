#pragma once
/// Spectra of short stretches of a signal, octave by octave: what is the same in all of them.
#include <complex>
#include <cstddef>
#include <vector>

namespace ambrig {

/// Lines k = 0 ... n/2 of a stretch of n rows. The square of a line is the power density [square of
/// the unit], of white noise its variance.
using StretchLines = std::vector<std::complex<double>>;

/// With Hann's window. `x`: a power of two of rows.
StretchLines LinesOfStretch(const std::vector<double>& x);

/// The lines `from` to the one before `to`.
struct LineBand {
  std::size_t from, to;
  std::size_t count() const { return to - from; }
};

/// Octaves from line 2 on, below which the window holds the mean, to the one before the last, at
/// half the rate.
std::vector<LineBand> OctavesOf(const StretchLines& lines);

/// Squared coherence of these lines in all stretches, 0 to 1.
double LineCoherence(const std::vector<StretchLines>& a, const std::vector<StretchLines>& b,
                     const LineBand& band);

/// Density of these lines that a quarter and three quarters of the stretches stay below, each
/// corrected for the scatter of noise: of noise that is the same in all stretches both are its
/// density.
struct DensityRange {
  double quarter, three_quarters;
  /// Whether the middle half of the stretches agrees.
  bool Agrees() const;
};
/// `independent`: lines of the band that are as good as independent ones of equal power.
DensityRange DensitiesOf(const std::vector<StretchLines>& of, const LineBand& band,
                         double independent);

/// Power of one line over all stretches [square of the unit].
struct LinePower {
  double mean, variance;
};
/// Of every line of the band.
std::vector<LinePower> PowersOf(const std::vector<StretchLines>& of, const LineBand& band);

/// How many lines of equal power vary as the power of these does: fewer where a resonance stands
/// out.
double IndependentLines(const std::vector<LinePower>& powers);

}  // namespace ambrig
