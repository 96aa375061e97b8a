#pragma once
/// `ambrig analyze` of a shaft alone as JSON: speeds in rad/s, frequencies in Hz, lengths in m, SI.
#include <nlohmann/json.hpp>

#include "analysis/shaft/shaft_analysis.h"

namespace ambrig {

nlohmann::ordered_json ShaftJson(const ShaftAnalysis& analysis);

}  // namespace ambrig
