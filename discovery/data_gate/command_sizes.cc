#include "discovery/data_gate/command_sizes.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>

#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

constexpr double kLeastAnswer = 1e-12;  // of the squared error: what an excitation has to move

}  // namespace

CommandSizes FindCommandSizes(const RigParameters& rig, const Scenario& scenario,
                              const BridgedRecord& data, const CommandReplay& replay) {
  CommandSizes out{std::vector<double>(scenario.excitations.size(), 1), 1};
  const Eigen::VectorXd error = CountedErrors(replay.now);
  if (error.squaredNorm() <= 0) return out;
  std::vector<std::size_t> seen;
  std::vector<Eigen::VectorXd> answers;  // what more of each excitation would leave
  for (std::size_t e = 0; e < scenario.excitations.size(); ++e) {
    Scenario without = scenario;
    without.excitations.erase(without.excitations.begin() + static_cast<std::ptrdiff_t>(e));
    const Eigen::VectorXd answer = CountedErrors(ControllerAxes(rig, without, data)) - error;
    if (answer.squaredNorm() <= kLeastAnswer * error.squaredNorm()) continue;
    seen.push_back(e);
    answers.push_back(answer);
  }
  if (seen.empty()) return out;
  Eigen::MatrixXd columns(error.size(), static_cast<Eigen::Index>(seen.size()));
  for (std::size_t k = 0; k < seen.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) = answers[k];
  const Eigen::VectorXd more = SolveLeastNorm(columns, error);
  for (std::size_t k = 0; k < seen.size(); ++k)
    out.of_excitations[seen[k]] += more(static_cast<Eigen::Index>(k));
  out.left = (error - columns * more).norm() / error.norm();
  return out;
}

std::string CommandSizesText(const Scenario& scenario, const std::vector<double>& sizes) {
  constexpr double kDiffers = 0.05;
  std::string out;
  for (std::size_t e = 0; e < sizes.size(); ++e)
    if (std::abs(sizes[e] - 1) > kDiffers)
      out += fmt::format("{}its {} at {} was {:.4g} times what the scenario says",
                         out.empty() ? "" : ", ", scenario.excitations[e].kind,
                         scenario.excitations[e].target, sizes[e]);
  return out;
}

}  // namespace ambrig
