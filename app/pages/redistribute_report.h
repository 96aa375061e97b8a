#pragma once
/// What is left of a radial bearing after coil failures: the figures and words of `ambrig
/// redistribute`.
#include <nlohmann/json.hpp>
#include <string>

#include "faulttolerance/supervision/failure_map.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

/// One failure set as runs treat it.
struct FailureSetFigures {
  std::vector<int> failed;  // from 1
  std::string map;          // "W, exact", "W, linearised", "force by force", "none"
  MapReach reach;
};

struct RedistributionFigures {
  std::string rig, bearing;
  Eigen::Vector2d load =
      Eigen::Vector2d::Zero();  // that the bearing carries: its share of the weight [N]
  double most = 0;              // of a command, per axis [N]
  MapReach healthy;
  std::vector<FailureSetFigures> sets;
  nlohmann::json json;  // RedistributionJson's, one entry per set
};

/// "{1,2}"
std::string SetText(const std::vector<int>& failed);
std::string RedistributionText(const RedistributionFigures& figures);
void WriteRedistributionReport(const RigParameters& rig, const RedistributionFigures& figures,
                               const std::string& html);

}  // namespace ambrig
