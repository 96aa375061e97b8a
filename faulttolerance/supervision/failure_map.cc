#include "faulttolerance/supervision/failure_map.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "faulttolerance/redistribution/inverse_allocation.h"
#include "faulttolerance/supervision/map_checks.h"

namespace ambrig {

namespace {

constexpr double kStep = 0.5;       // [N]
constexpr double kWrong = 0.05;     // of the force
constexpr double kLeastForce = 1;   // [N] smaller ones count as this
constexpr double kTrueAdded = 0.5;  // of a force beside the load, which may be small beside it
constexpr double kMostMargin = 100;
// The integrator of the position loop: of the missing force in one step, steps
constexpr double kIntegrates = 0.5;
constexpr int kMostSteps = 60;
constexpr double kLeastMapGain = 0.1;  // of a map, over that of the healthy bearing

bool Within(const Eigen::Vector2d& force, double most) {
  return force.cwiseAbs().maxCoeff() <= most;
}

/// The network's force for forces that are wanted one after the other. A force by force inverse is
/// commanded what is wanted. At the load the command of a matrix is what the position loop's
/// integrator makes it, within what commands are limited to: a linearised one has another gain than
/// that of the healthy bearing, and where its gain has another sign the integrator finds no
/// command. From there on the command goes with the map's gain at the load.
class Pull {
 public:
  Pull(const RedistributionProblem& left, const CurrentMap& map, const Eigen::Vector2d& load,
       double most)
      : network_(left), map_(map), inverse_(left), load_(load), command_(load), most_(most) {
    if (map.allocation) {
      by_force_ = true;
      started_ = inverse_.Start(load);
      return;
    }
    for (int step = 0; step < kMostSteps; ++step)
      command_ = (command_ + kIntegrates * (load - Of(command_))).cwiseMax(-most).cwiseMin(most);
    Eigen::Matrix2d gain;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d by = 0.5 * kStep * Eigen::Vector2d::Unit(axis);
      gain.col(axis) = (Of(command_ + by) - Of(command_ - by)) / kStep;
    }
    started_ = std::abs(gain.determinant()) > kLeastMapGain * kLeastMapGain;
    if (started_) per_force_ = gain.inverse();
  }
  bool Gives(const Eigen::Vector2d& force) {
    if (!Within(force, most_) || !started_) return false;
    const double whole = kWrong * std::max(force.norm(), kLeastForce),
                 added = (force - load_).norm(),
                 wrong = added > 0 ? std::min(whole, kTrueAdded * added) : whole;
    const Eigen::Vector2d truly = by_force_ ? network_.Force(inverse_.Step(force))
                                            : Of(command_ + per_force_ * (force - load_));
    return (truly - force).norm() <= wrong;
  }

 private:
  Eigen::Vector2d Of(const Eigen::Vector2d& command) const {
    return network_.Force(map_.SetPoints(command.x(), command.y()));
  }

  NetworkForce network_;
  const CurrentMap& map_;
  ForceInverse inverse_;
  Eigen::Vector2d load_, command_;
  Eigen::Matrix2d per_force_ = Eigen::Matrix2d::Identity();
  double most_;
  bool by_force_ = false, started_ = false;
};

/// How far from `load` along `direction` forces are true [N].
double Along(Pull pull, const Eigen::Vector2d& load, const Eigen::Vector2d& direction) {
  double r = 0;
  while (pull.Gives(load + (r + kStep) * direction)) r += kStep;
  return r;
}

Eigen::Vector2d WayOf(int k) {
  const double angle = 2 * kPi * k / MapReach::kDirections;
  return {std::cos(angle), std::sin(angle)};
}

/// Whether forces are true beside the load in all directions: held, not only passed through.
bool Holds(const Pull& at_load, const Eigen::Vector2d& load) {
  for (int k = 0; k < MapReach::kDirections; ++k) {
    Pull pull = at_load;
    if (!pull.Gives(load + kStep * WayOf(k))) return false;
  }
  return true;
}

double MarginAlong(const Pull& at_load, const Eigen::Vector2d& load) {
  if (!(load.norm() > 0)) return 0;
  return std::min(kMostMargin, 1 + Along(at_load, load, load.normalized()) / load.norm());
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
  // What follows goes on from the place that an inverse, or a command, has at the load.
  Pull at_load(left, map, load, most);
  if (!at_load.Gives(load)) return out;
  out.worst = kInfinity;
  for (int k = 0; k < MapReach::kDirections; ++k) {
    out.radius[k] = Along(at_load, load, WayOf(k));
    if (out.radius[k] >= out.worst) continue;
    out.worst = out.radius[k];
    out.worst_direction = k;
  }
  out.carries = out.worst > 0;
  out.margin = out.carries ? MarginAlong(at_load, load) : 0;
  return out;
}

double MarginOfMap(const RedistributionProblem& left, const CurrentMap& map,
                   const Eigen::Vector2d& load, double most) {
  Pull at_load(left, map, load, most);
  return at_load.Gives(load) && Holds(at_load, load) ? MarginAlong(at_load, load) : 0;
}

}  // namespace ambrig
