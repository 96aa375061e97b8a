#include "faulttolerance/supervision/failure_map.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "faulttolerance/redistribution/inverse_allocation.h"
#include "faulttolerance/supervision/map_checks.h"

namespace ambrig {

namespace {

constexpr double kStep = 0.5;      // [N]
constexpr double kWrong = 0.05;    // of the force
constexpr double kLeastForce = 1;  // [N] smaller ones count as this
constexpr double kMostMargin = 100;

/// The network's force for commands that follow each other.
class Pull {
 public:
  Pull(const RedistributionProblem& left, const CurrentMap& map, const Eigen::Vector2d& load)
      : network_(left), map_(map), inverse_(left) {
    if (!map.allocation) return;
    by_force_ = true;
    started_ = inverse_.Start(load);
  }
  bool Gives(const Eigen::Vector2d& force) {
    if (by_force_ && !started_) return false;
    const CoilVector set = by_force_ ? inverse_.Step(force) : map_.SetPoints(force.x(), force.y());
    return (network_.Force(set) - force).norm() <= kWrong * std::max(force.norm(), kLeastForce);
  }

 private:
  NetworkForce network_;
  const CurrentMap& map_;
  ForceInverse inverse_;
  bool by_force_ = false, started_ = false;
};

bool Within(const Eigen::Vector2d& force, double most) {
  return force.cwiseAbs().maxCoeff() <= most;
}

/// How far from `load` along `direction` forces are true [N].
double Along(Pull pull, const Eigen::Vector2d& load, const Eigen::Vector2d& direction,
             double most) {
  double r = 0;
  while (true) {
    const Eigen::Vector2d next = load + (r + kStep) * direction;
    if (!Within(next, most) || !pull.Gives(next)) return r;
    r += kStep;
  }
}

/// `at_load` is a copy: an inverse that goes on from the load keeps its place.
bool Carries(Pull at_load, const Eigen::Vector2d& load, double most) {
  return Within(load, most) && at_load.Gives(load);
}

double MarginAlong(const Pull& at_load, const Eigen::Vector2d& load, double most) {
  if (!(load.norm() > 0)) return 0;
  return std::min(kMostMargin, 1 + Along(at_load, load, load.normalized(), most) / load.norm());
}

}  // namespace

std::string MapAfterFailure(const RedistributionTable& table, const CoilVector& turns_left,
                            const Eigen::Vector2d& force, const FailureMapOptions& options,
                            CurrentMap* map) {
  RedistributionProblem left = table.problem();
  const Eigen::Matrix2d healthy =
      Describe(left, SolvabilityClass::kExact, HealthyDistribution(left)).stiffness;
  left.turns_left = turns_left;
  map->allocation = nullptr;
  map->stiffness_change.setZero();
  const Distribution found = table.Lookup(turns_left);
  map->W = found.W;
  const bool matrix = options.redistribution == "matrix" ||
                      (options.redistribution == "auto" && GivesForce(force, left, found, *map));
  if (!matrix) {
    ForceInverse inverse(left);
    if (inverse.Start(force)) {
      map->allocation = std::make_shared<InverseAllocation>(inverse, healthy);
      return "force by force";
    }
  }
  if (options.stiffness_compensation)
    map->stiffness_change = DestabilisingPart(healthy - found.stiffness);
  return ToText(found.cls);
}

MapReach ReachOfMap(const RedistributionProblem& left, const CurrentMap& map,
                    const Eigen::Vector2d& load, double most) {
  MapReach out;
  const Pull at_load(left, map, load);
  out.carries = Carries(at_load, load, most);
  if (!out.carries) return out;
  out.worst = kInfinity;
  for (int k = 0; k < MapReach::kDirections; ++k) {
    const double angle = 2 * kPi * k / MapReach::kDirections;
    out.radius[k] = Along(at_load, load, {std::cos(angle), std::sin(angle)}, most);
    if (out.radius[k] >= out.worst) continue;
    out.worst = out.radius[k];
    out.worst_direction = k;
  }
  out.margin = MarginAlong(at_load, load, most);
  return out;
}

double MarginOfMap(const RedistributionProblem& left, const CurrentMap& map,
                   const Eigen::Vector2d& load, double most) {
  const Pull at_load(left, map, load);
  return Carries(at_load, load, most) ? MarginAlong(at_load, load, most) : 0;
}

}  // namespace ambrig
