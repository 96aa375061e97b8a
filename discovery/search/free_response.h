#pragma once
/// Spectra of the records of a free rotor: what the magnets pull, by measured currents and
/// positions, and how far the readings are from what the model's shaft does under that pull. The
/// control loop has no part in it, so errors of controllers, amplifiers and delays do not show.
/// What the model's own record shows in the same way (a sensor's gain, fringing flux that it holds)
/// is taken off.
///
/// A record is neither periodic nor at rest at its ends. Of a second-order system with the
/// denominator D(w) its lines X and those of the force F, both without a window, obey D
/// X = F + a + i w b exactly, with constants a and b of the difference between the states at both
/// ends; Hann's window is a difference of neighbouring lines. Forces are therefore kept without a
/// window, and a resonance sharper than a line is described as well as any. Source: R. Pintelon, J.
/// Schoukens, G. Vandersteen, IEEE Trans. Autom. Control 42 (1997) 1717.
#include <array>
#include <complex>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// One direction of whirl of one record: forward X + iY or backward X - iY, whose equations at a
/// constant speed are those of a single axis.
struct FreeResponse {
  int direction = 1;      // +1 forward, -1 backward
  double speed = 0;       // [rad/s], of the shaft
  double line = 0;        // [rad/s], width of a line
  std::vector<double> w;  // [rad/s], increasing
  using Series = std::vector<std::complex<double>>;
  using Neighbours = std::array<std::complex<double>, 3>;  // one line below, at the line, one above
  std::array<std::vector<Neighbours>, 2> force;  // [N], of both radial bearings, no window
  std::array<Series, 2> missing;  // [m], readings there less the model's answer, Hann's window
  std::array<std::vector<double>, 2> scale;  // [m], how large an error is to be expected there
};

/// Through Hann's window 1 - cos(2 pi k/n), of values without a window.
inline std::complex<double> Windowed(const FreeResponse::Neighbours& v) {
  return v[1] - 0.5 * (v[0] + v[2]);
}

/// Of the fitted records at constant speed without loads, with all currents and readings of two
/// eight-pole bearings; both directions of each. Empty where no record is one of these.
std::vector<FreeResponse> FreeResponses(const CaseModel& model, const Hypothesis& h);

}  // namespace ambrig
