#include "discovery/model/nuisance_group.h"

#include <stdexcept>

namespace ambrig {

std::string ToText(NuisanceGroup group) {
  switch (group) {
    case NuisanceGroup::kSensorZero:
      return "sensor zero";
    case NuisanceGroup::kLoggerZero:
      return "logger zero";
    case NuisanceGroup::kDrift:
      return "drift";
    case NuisanceGroup::kTimeShift:
      return "time shift";
    case NuisanceGroup::kInputGain:
      return "input gain";
    case NuisanceGroup::kCurrentGain:
      return "current gain";
    case NuisanceGroup::kEdge:
      return "edge";
  }
  throw std::logic_error("group of nuisances");
}

}  // namespace ambrig
