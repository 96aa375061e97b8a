#pragma once
/// Frequency responses in text tables: a first column of frequencies, then real and imaginary parts
/// or magnitudes and phases, as network and signal analysers export them:
///
///   Frequency (Hz);Trace 1: Gain: Magnitude (dB);Trace 2: Gain: Phase (deg)
///   f [kHz],Re(A.x/A.fx) [um/N],Im(A.x/A.fx) [um/N]
#include <string>

#include "core/record/measurement.h"
#include "core/record/text_table.h"

namespace ambrig {

/// Whether the first column is a frequency (f, freq, frequency with a unit of frequency
/// or none) and no other is a time.
bool IsFrequencyTable(const TextTable& table);

/// Parts of one response are those whose heads agree but for Re/Im, Real/Imag, Abs/Phi,
/// Magnitude/Phase, as `Re(NAME)` or behind NAME; what has no partner is left out with a note.
/// `Coherence(NAME)` or a column `Coherence` is no part of a response but stands beside it.
/// @throws InputError
Measurement ResponsesOfTable(const TextTable& table, const std::string& path);

}  // namespace ambrig
