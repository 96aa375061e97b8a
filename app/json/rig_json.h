#pragma once
/// A rig file resolved: every number with its unit, tolerance and calibrated value, defaults and
/// `like` filled in, and what a drawing of it needs; and what differs between two such rigs.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// { "name", "gravity", "values": { path: { "value", "unit", "sd", "fitted" } }, "bearings": [ {
/// "name", "kind", "z", "axes", "clearance", "coils": [ { "name", "angle_deg", "turns", "gap" } ] }
/// ], "effects", "controller" }. Angles within ±180 from the x axis; turns signed; lengths [m].
nlohmann::ordered_json RigJson(const RigParameters& rig);

/// One thing that is not the same in both rigs; an empty text: not there.
struct RigDifference {
  std::string what;  // path of a number, "effect cross-coupling at A: stiffness", "bearing Z"
  std::string unit, a, b;
  double sds = 0;  // (b - a) over the sd of the tolerance; 0: it has none
};

/// Only what differs, in the order of the files: what simulates (the calibrated value where there
/// is one, else the nominal ones), tolerances, bearings and effects.
std::vector<RigDifference> RigDifferences(const RigParameters& a, const RigParameters& b);

}  // namespace ambrig
