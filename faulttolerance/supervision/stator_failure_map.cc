#include "faulttolerance/supervision/stator_failure_map.h"

#include "faulttolerance/supervision/map_checks.h"

namespace ambrig {

StatorProblem StatorProblemOf(std::shared_ptr<const PoleNetwork> network, int axes,
                              const CurrentMap& healthy, const CoilVector& turns_left,
                              const Eigen::Vector2d& load) {
  StatorProblem p;
  const Eigen::Index coils = network->coils();
  p.network = std::move(network);
  p.axes = axes;
  p.healthy = healthy.W.topRows(coils);
  p.turns_left = turns_left.head(coils);
  p.k = healthy.k;
  p.c0 = healthy.c0;
  p.i_max = healthy.i_max;
  p.unipolar = healthy.unipolar;
  p.load = load;
  return p;
}

std::string StatorMapAfterFailure(const StatorProblem& problem, bool stiffness_compensation,
                                  CurrentMap* map) {
  StatorProblem whole = problem;
  whole.turns_left.setOnes();
  whole.load.setZero();
  const Eigen::Matrix2d healthy =
      DescribeStator(whole, SolvabilityClass::kExact, problem.healthy).stiffness;
  const StatorDistribution found = SolveStator(problem);
  map->stiffness_change.setZero();
  map->W.setZero();
  const Eigen::Index coils = problem.network->coils();
  if (found.cls == SolvabilityClass::kNone) {
    for (Eigen::Index j = 0; j < coils; ++j)
      if (problem.turns_left[j] > 0) map->W.row(j) = problem.healthy.row(j);
    return ToText(found.cls);
  }
  map->W.topRows(coils) = found.W;
  if (stiffness_compensation) map->stiffness_change = DestabilisingPart(healthy - found.stiffness);
  return ToText(found.cls) + std::string(found.load.norm() > 0 ? " about the load" : "");
}

}  // namespace ambrig
