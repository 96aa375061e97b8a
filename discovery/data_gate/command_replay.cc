#include "discovery/data_gate/command_replay.h"

#include <utility>

namespace ambrig {

CommandReplay ReplayCommands(const RigParameters& rig, const Scenario& scenario,
                             const BridgedRecord& data, std::vector<ControllerAxis> now) {
  Scenario silent = scenario;
  silent.excitations.clear();
  return {ControllerAxes(rig, silent, data), std::move(now)};
}

Eigen::VectorXd CountedErrors(const std::vector<ControllerAxis>& axes) {
  std::vector<double> out;
  for (const ControllerAxis& a : axes)
    for (std::size_t k = 0; k < a.error.size(); ++k)
      if (a.counts[k]) out.push_back(a.error[k]);
  return Eigen::Map<const Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
}

}  // namespace ambrig
