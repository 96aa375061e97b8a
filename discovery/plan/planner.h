#pragma once
/// The search behind a plan: candidates, safety, distances, confirmation.
#include <optional>

#include "discovery/plan/candidates.h"
#include "discovery/plan/plan.h"
#include "discovery/plan/safety.h"

namespace ambrig {

class Planner {
 public:
  /// What the next record has beside physics: rms noise by channel as in a case, nuisances.
  struct Surroundings {
    std::map<std::string, double> noise;
    NuisancePriors nuisances;
  };
  /// `rivals`: at least two, one of them may be "nothing".
  Planner(const RigParameters& rig, const Abilities& abilities, Surroundings surroundings,
          std::vector<Rival> rivals, Hypothesis nothing, const PlanOptions& options);
  Plan Run();

 private:
  /// A candidate at a size that the rig survives, with what it shows.
  struct Scored {
    PlanCandidate candidate;
    double size = 1, least = -1;  // least: probability of a pair
    SafetyResult safety;
    std::vector<double> probabilities;  // of taking the right one, per pair
  };
  TrialRecord Trial(const std::string& toml, const PlanCandidate& c) const;
  std::optional<Scored> Score(const PlanCandidate& c, TriedScenario* tried);
  /// Floors, nuisances and weight of a trial record.
  void Prepare(TrialRecord* trial) const;
  /// One for each rival; nothing when one of them loses the rotor.
  std::optional<std::vector<RivalView>> Views(const TrialRecord& trial) const;
  void Confirm(const Scored& best, Plan& plan);
  /// Whether the truth `pair[which]` is found in one simulated record of it.
  std::optional<bool> Decide(const TrialRecord& trial, const std::vector<RivalView>& views,
                             std::size_t truth, std::size_t other, std::uint64_t seed) const;
  std::string Card(const Plan& plan, const Scored& best) const;
  std::vector<std::pair<std::size_t, std::size_t>> Pairs() const;
  void Progress(double f, const std::string& text) const;

  const RigParameters& rig_;
  Abilities abilities_;
  Surroundings surroundings_;
  std::vector<Rival> rivals_;
  Hypothesis nothing_;
  PlanOptions options_;
  mutable long runs_ = 0;
};

}  // namespace ambrig
