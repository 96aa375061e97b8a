#pragma once
/// The map of a radial bearing that runs go to when turns are lost, and what it can pull.
#include "control/current/current_map.h"
#include "faulttolerance/redistribution/redistribution_table.h"

namespace ambrig {

/// What decides between W and the force-by-force inverse: see FaultSupervisorOptions.
struct FailureMapOptions {
  std::string redistribution = "auto";
  bool stiffness_compensation = true;
};

/// Puts the map for `turns_left` in the place of `map`, at a command of `force` [N]. Returns its
/// class for the record: "exact", "linearised", "none", "force by force".
std::string MapAfterFailure(const RedistributionTable& table, const CoilVector& turns_left,
                            const Eigen::Vector2d& force, const FailureMapOptions& options,
                            CurrentMap* map);

/// Forces that a map truly gives at the centre, told by the reluctance network (network_force.h),
/// which made neither W nor its figures: set-points are clamped to the amplifiers' range, then the
/// network says what they pull.
struct MapReach {
  static constexpr int kDirections = 24;
  bool carries = false;  // the load itself, and something beside it in every direction
  double margin = 0;     // largest multiple of the load that is pulled, from it on; 0: no load
  double worst = 0;      // [N] from the load in the worst direction
  int worst_direction = 0;
  double radius[kDirections] = {};  // [N] from the load, direction k at k 15 deg
};

/// True: every force between is given within 5 % of itself and of 1 N, and what it adds to the load
/// within half of that. A matrix gives the load by the command that an integrator finds. `most`:
/// commands and forces are never larger, per axis [N].
MapReach ReachOfMap(const RedistributionProblem& left, const CurrentMap& map,
                    const Eigen::Vector2d& load, double most);
/// Its margin alone; 0 where the load is not carried, or is none.
double MarginOfMap(const RedistributionProblem& left, const CurrentMap& map,
                   const Eigen::Vector2d& load, double most);

}  // namespace ambrig
