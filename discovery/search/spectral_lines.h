#pragma once
/// Sharp lines of an error: tones that a coarse grid of frequencies would step over.
#include <vector>

#include "discovery/model/residual.h"

namespace ambrig {

struct LineBand {
  double from = 0;        // [Hz]
  std::size_t count = 0;  // strongest lines
};

/// The longest of these targets' records [s].
double LongestRecord(const CaseModel& model, const std::vector<std::size_t>& targets);

/// Frequencies [Hz] of the strongest lines that the residuals of these targets (places in
/// `model.targets()`) have between `band.from` and 0.4 of their sampling rate, any phase, strongest
/// first: their Fourier transforms, padded to twice their length, powers added. `residual`: over
/// the floor [-].
std::vector<double> StrongestLines(const CaseModel& model, const std::vector<double>& residual,
                                   const std::vector<std::size_t>& targets, const LineBand& band);

/// Places of the local maxima of `power` over ascending frequencies f [Hz], strongest first, at
/// most `count`, each further than a share `apart` from those before it.
std::vector<double> Peaks(const std::vector<double>& f, const std::vector<double>& power,
                          std::size_t count, double apart);

}  // namespace ambrig
