#pragma once
/// Run k of a campaign: which case, under which conditions, and the rig and scenario to simulate.
/// Any run can be made by its number alone, in any order, on any machine.
#include <optional>

#include "campaign/campaign_file.h"
#include "campaign/commissioned_plants.h"
#include "faulttolerance/redistribution/redistribution_table.h"

namespace ambrig {

/// Indices of run k in the campaign's lists; the last one counts fastest.
struct RunIndex {
  std::size_t scenario = 0, fault = 0, phase = 0, speed = 0, load = 0, position = 0, draw = 0,
              seed = 0, plant = 0;
};

RunIndex IndexOf(const Campaign& c, std::size_t run);

/// What the theory says of the set of a run: class and largest static force.
struct SetCapacity {
  std::string cls;      // "healthy", "exact", "linearised", "none"
  double capacity = 0;  // k c0² rho, at most the controller's f_max; 0 when the class is none [N]
};

struct PlannedRun {
  std::size_t run = 0;
  RunIndex at;
  RigParameters rig;  // tolerances carry this draw as `true_value`: what the plant has
  Scenario scenario;
  std::string bearing;  // that the faults and the load act on
  SetCapacity theory;
  double speed = 0;                      // at the fault [rad/s]
  double load = 0;                       // added to the weight [N]
  std::optional<double> margin;          // when all its faults are there, see RunPlan::MarginAt
  const CampaignPlant* plant = nullptr;  // of the campaign's [plants]
};

class RunPlan {
 public:
  explicit RunPlan(const Campaign& campaign);
  RunPlan(const RunPlan&) = delete;
  RunPlan& operator=(const RunPlan&) = delete;
  const Campaign& campaign() const { return campaign_; }
  /// Thread-safe. @throws std::logic_error for run >= campaign().runs().
  PlannedRun Make(std::size_t run) const;
  /// Largest multiple of load and weight that the map of the coils left at t pulls, at the centre,
  /// at rest (failure_map.h); none: coils that no map is made for.
  std::optional<double> MarginAt(const PlannedRun& p, double t) const;

 private:
  SetCapacity Theory(const FailureSet& set, const CampaignFaultKind& kind) const;
  void AddFaults(const RunIndex& at, Scenario& s) const;
  void AddLoad(PlannedRun& p) const;
  void AddPosition(PlannedRun& p) const;

  Campaign campaign_;
  std::map<std::string, std::unique_ptr<RedistributionTable>> tables_;
  std::unique_ptr<CommissionedPlants> commissioned_;
};

}  // namespace ambrig
