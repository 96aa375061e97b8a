#pragma once
/// A detector study as text, JSON and HTML.
#include <nlohmann/json.hpp>

#include "campaign/detector_curves.h"

namespace ambrig {

/// Tables for a terminal: at the study's budget of false alarms, and at the detectors' own
/// thresholds.
std::string DetectorText(const DetectorStudy& study, const std::vector<DetectorCurves>& curves,
                         const Rows& rows);
/// Everything that the curves hold; a delay that is not reached is null.
nlohmann::ordered_json DetectorJson(const DetectorStudy& study,
                                    const std::vector<DetectorCurves>& curves, const Rows& rows);
/// @throws InputError when it cannot be written.
void WriteDetectorReport(const DetectorStudy& study, const std::vector<DetectorCurves>& curves,
                         const Rows& rows, const std::string& path);

}  // namespace ambrig
