#pragma once
/// campaign.toml: many runs of one rig. The runs are the product of everything the file lists;
/// docs/guide/campaign.md explains each key by example.
#include <cstdint>
#include <string>
#include <vector>

#include "campaign/parameter_draw.h"
#include "campaign/plants.h"
#include "scenarios/scenario.h"
#include "simulation/commissioning/commissioning_scenario.h"

namespace ambrig {

struct FailureSet {
  std::string bearing;
  std::vector<int> coils;  // from 1; empty: healthy
};

struct CampaignFaultKind {
  std::string label;  // "partial-short fraction=0.5"
  std::string kind;
  std::map<std::string, double> parameters;
};

/// Which coils fail, how, and whether together or one after the other.
struct FaultCase {
  std::size_t set = 0, kind = 0;
  bool sequential = false;
};

enum class LoadUnit { kCapacity, kNewton };

inline constexpr std::size_t kMostRuns = 10'000'000;  // of a campaign

struct Campaign {
  std::string name, file, fingerprint;  // of the file and all that it names
  RigParameters rig;
  std::vector<Scenario> scenarios;  // what every run starts from
  std::vector<FailureSet> sets;
  std::vector<CampaignFaultKind> kinds;
  std::vector<FaultCase> cases;
  double fault_time = 0, spacing = 0;  // [s]
  std::vector<double> phases{0};       // of the control period
  std::vector<double> speeds;          // [rad/s]; empty: the scenario's
  std::vector<double> loads{0};
  LoadUnit load_unit = LoadUnit::kCapacity;
  double load_angle = 0;             // [rad]
  std::vector<double> positions{0};  // of the clearance
  double position_angle = 0;         // [rad]
  // [draw][tolerance with sd]: normal deviates; one empty: nominal
  std::vector<std::vector<double>> draws;
  std::vector<std::uint64_t> seeds{1};
  std::vector<CampaignPlant> plants;  // empty: the rig file's alone
  bool without = false;               // every run is made a second time without fault tolerance
  CommissioningPlan commissioning;    // of the plants

  std::size_t runs() const;
  /// How many runs in a row are best made by one worker of so many: those of a plant, which share
  /// its commissioning, where there are enough plants for all; else 1.
  std::size_t RunsTogether(std::size_t workers) const;
};

/// Whether the shaft can be held away from its centre at this bearing by what is known of it: a
/// share of the clearance needs an auxiliary bearing, the reference the stiffness of eight poles.
bool HoldsPositions(const BearingParameters& b);

/// @throws InputError "file:line: key = value, allowed ..." for every mistake.
Campaign ReadCampaign(const std::string& file);

}  // namespace ambrig
