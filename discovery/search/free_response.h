#pragma once
/// Spectra of the records of a free rotor: what the magnets pull, by measured currents and positions, and how far
/// the readings are from what the model's shaft does under that pull. The control loop has no part in it, so
/// errors of controllers, amplifiers and delays do not show.
#include <array>
#include <complex>
#include <vector>

#include "discovery/model/model.h"

namespace ambrig {

/// One direction of whirl of one record: forward X + iY or backward X - iY, whose equations at a constant speed
/// are those of a single axis.
struct FreeResponse {
  int direction = 1;      // +1 forward, -1 backward
  double speed = 0;       // [rad/s], of the shaft
  double line = 0;        // [rad/s], width of a line
  std::vector<double> w;  // [rad/s], increasing
  using Series = std::vector<std::complex<double>>;
  std::array<Series, 2> force;  // [N], of the two radial bearings
  std::array<Series, 2>
      missing;  // [m], reading less the model's answer to the forces, of their sensors
  std::array<std::vector<double>, 2> scale;  // [m], how large an error is to be expected there
};

/// Of the fitted records at constant speed without loads, with all currents and readings of two eight-pole
/// bearings; both directions of each. Empty where no record is one of these.
std::vector<FreeResponse> FreeResponses(const CaseModel& model, const Hypothesis& h);

}  // namespace ambrig
