#pragma once
/// Rows of a campaign over plants, gathered: what happened to healthy plants and which faults were
/// found. A plant counts once, however many runs it has.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "campaign/journal.h"

namespace ambrig {

/// Runs with faults of one kind.
struct FaultsOnPlants {
  std::size_t runs = 0, found = 0;
  std::size_t blamed = 0;                // runs in which a coil without a fault was acted on
  std::size_t lost = 0, lost_alone = 0;  // that touched down or dropped, with and without tolerance
  std::vector<double> delay;             // of the slowest coil; only of runs with all found [s]

  bool complete() const { return found == runs && blamed == 0; }
  /// Delay that `share` of the found faults keep to [s]; none found: nan.
  double Delay(double share) const;
  /// Runs whose fault was found within `delay` [s], of several the slowest.
  std::size_t FoundWithin(double delay) const;
};

struct PlantGroup {
  // Healthy runs: those that were run; with a false alarm; acted on; that ended worse than without
  // fault tolerance (a drop, a touchdown, an orbit above 1.1 times); that doubted their model.
  std::set<std::string> plants, alarmed, acted, harmed, doubtful;
  double coil_periods = 0;      // healthy
  double doubtful_periods = 0;  // of these, with the model of the detector in doubt
  // of the run that fault tolerance made worst, of those that stay up both with and without it [m]
  double orbit = 0, orbit_without = 0;
  std::map<std::string, FaultsOnPlants> kinds;

  double DoubtfulShare() const { return coil_periods > 0 ? doubtful_periods / coil_periods : 0; }
  void Add(const Row& row);
  /// `prefix` keeps plants of equal names of different groups apart.
  void Add(const PlantGroup& other, const std::string& prefix);
};

/// Upper end of the one-sided 95 % interval of a probability of which `hits` of `trials` were seen
/// (Clopper and Pearson); about 3/n where none was. 1 without trials.
double UpperBound95(std::size_t hits, std::size_t trials);

}  // namespace ambrig
