#pragma once
/// Whether what a model leaves of a channel is noise: the same in all stretches however they are
/// driven, coherent with nothing that the model predicts, and of no line. A sensor's noise that
/// goes round a control loop has any spectrum.
#include <cstddef>
#include <optional>
#include <vector>

namespace ambrig {

/// Rows of one channel that follow each other.
struct DrivenStretch {
  std::vector<double> error;                   // measured minus predicted
  std::vector<std::vector<double>> predicted;  // of the channel itself, then of others
};

struct StationaryNoise {
  double rms = 0;     // [unit of the error]
  double middle = 0;  // of the octave that holds most of it, over the rate of the rows [-]
};

/// Stretches from which on the noise of a channel can be told.
inline constexpr std::size_t kFewestOfNoise = 16;

/// `stretches`: of equal length, a power of two; `expected`: rms of the noise that is known.
/// Nothing where the error is something else, or where it cannot be told: fewer than
/// kFewestOfNoise, or all of them driven alike (the motion of the weakest tenth is above a third of
/// that of the strongest).
///
/// Of every octave that holds a twentieth of the error's power the middle half of the stretches
/// agrees on the density; its coherence with no prediction exceeds what chance allows once in a
/// hundred times, or a third of the power that is not expected; and of a line that holds a seventh
/// of it the power comes and goes as that of noise does, whose standard deviation is its mean.
std::optional<StationaryNoise> StationaryNoiseOf(const std::vector<DrivenStretch>& stretches,
                                                 double expected);

}  // namespace ambrig
