#pragma once
/// The next record: of the scenarios that a rig can make and survives, the one that tells the names
/// that are left apart best; its promise is checked with simulated records. Method:
/// docs/theory/plan.md.
#include <string>
#include <utility>
#include <vector>

#include "discovery/decision/explanation.h"
#include "discovery/plan/abilities.h"
#include "discovery/plan/rivals.h"

namespace ambrig {

using EffectNames = std::vector<std::pair<std::string, std::string>>;  // effect, target or ""

struct PlannedPair {
  std::string a, b;
  double distance = 0;       // standard deviations
  double probability = 0;    // of taking the right one of the two
  int right = 0, draws = 0;  // simulated records, and how many were decided rightly
};

struct TriedScenario {
  std::string title;
  double size = 0;            // of its usual excitation
  double largest_orbit = 0;   // [m]
  std::string orbit_at = {};  // the bearing that shows it
  double orbit_share = 0;     // [-] of any bearing's orbit, of what is allowed there
  double least_distance = 0;  // of the pair that it separates worst, standard deviations
  std::string refused;        // why it was not taken into account; empty: it was
};

struct Plan {
  std::vector<std::string> names;
  std::vector<PlannedPair> separates;
  std::vector<TriedScenario> tried;               // best first
  std::string title, toml, text;                  // of the scenario; the card, markdown
  double duration = 0, record_rate = 0;           // [s], [Hz]
  double largest_orbit = 0, largest_current = 0;  // [m], [A], of all names
  std::vector<std::string> channels;
  std::vector<std::string> warnings;
  long runs = 0;  // record simulations
};

struct PlanOptions {
  int draws = 30;  // per pair
  std::uint64_t seed = 1;
  std::function<void(double, const std::string&)> progress;
  const std::atomic<bool>* stop = nullptr;
};

/// What tells `names` apart that a case leaves open ("nothing": no effect). @throws InputError
Plan PlanForCase(const Case& c, const EffectNames& names, const PlanOptions& options);

/// Names that explain leaves open, at most `most`: its 95 % set, or the best two of the ranking.
EffectNames NamesLeft(const Explanation& e, std::size_t most = 4);

/// A first record of a rig that should show each of `effects`, told from the others and from
/// nothing, at the middle of its usual size. @throws InputError
Plan PlanForRig(const RigParameters& rig, const EffectNames& effects, const Abilities& abilities,
                const PlanOptions& options);

}  // namespace ambrig
