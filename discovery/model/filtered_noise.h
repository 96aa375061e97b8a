#pragma once
/// Noise of channels that an amplifier or a filter leaves less of at high frequencies, from what
/// the model leaves.
#include <map>
#include <string>
#include <vector>

#include "discovery/data/noise_spectrum.h"

namespace ambrig {

class CaseModel;

/// Of load cells, of the bus, and of the readings of held rotors: what comes round a control loop
/// is no noise of a sensor. `white`: rms of the white part of each channel [SI]. Channels with
/// fewer than 8 stretches of 256 rows are left out, and those whose noise is white within a factor
/// of 1.35.
std::map<std::string, FilteredNoise> FilteredNoises(const CaseModel& model,
                                                    const std::vector<double>& predicted,
                                                    const std::map<std::string, double>& white);

}  // namespace ambrig
