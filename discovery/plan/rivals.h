#pragma once
/// The names that are left, each as a fitted model with what is known of its numbers: what a next
/// record should tell apart.
#include <Eigen/Dense>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "discovery/search/fit.h"
#include "effects/effect.h"

namespace ambrig {

struct Rival {
  std::string effect, target;  // "nothing", "" without an effect
  Hypothesis hypothesis;       // at its best point so far
  Eigen::MatrixXd precision;   // of the free parameters' coordinates, from prior and records so far
  Eigen::MatrixXd drawn;       // the same for the models that records are simulated with
  std::string Name() const { return NameAtTarget(effect, target); }
};

/// What one record would show of one rival, over the floor.
struct RivalView {
  std::vector<double> predicted;
  Eigen::MatrixXd columns;  // sensitivities of its free parameters, nuisances, law variations
  Eigen::MatrixXd
      weight;  // prior precision of all columns; of a variation of the law: for one of size 1
  Eigen::Index law = 0;  // columns at the end that vary the law
};

/// A model of one possible record, its floors set.
struct TrialRecord {
  std::unique_ptr<Case> data;
  std::unique_ptr<CaseModel> model;
  double row_weight = 1;  // of a squared error over the floor
  // what the record may have beside physics (nuisances.h), one sd each: columns over the floor;
  // none: no columns
  Eigen::MatrixXd nuisances;
};

/// How far the law of a real machine is from the catalogue's is not known, only how often it is how
/// far: in every eighth of a record, and in every channel, the effect's signature may differ by
/// `size` (sd, of itself). What stays of effects that were named rightly in cases of ambrig
/// practice (docs/theory/plan.md).
struct LawVariation {
  double size, share;
};
inline constexpr LawVariation kLawVariations[] = {{0.1, 0.5}, {0.2, 0.3}, {0.4, 0.2}};
inline constexpr int kLawBlocks = 8;             // of time
inline constexpr std::size_t kLawChannels = 16;  // those that show most of it

/// `nothing`: prediction of the model without the rivals' effects. Nothing when the rotor is lost.
std::optional<RivalView> ViewOf(const TrialRecord& trial, const Rival& rival,
                                const std::vector<double>& nothing);

/// Squared distance of two rivals' predictions in standard deviations, whatever their numbers and
/// laws do to come nearer: min over b of |d - C b|² + bᵀ P b. One for each of kLawVariations.
std::vector<double> SquaredDistances(const TrialRecord& trial, const RivalView& a,
                                     const RivalView& b);

/// -2 ln of the evidence of a record under a rival, constants left out. `data`: rows of the trial.
double Disbelief(const TrialRecord& trial, const RivalView& view, const std::vector<double>& data);

/// Probability that the nearer of two models is the right one: Φ(Δ/2) at a squared distance Δ², and
/// the mean of that over kLawVariations.
double ProbabilityRight(double squared_distance);
double ProbabilityRight(const std::vector<double>& squared_distances);

/// The distance at which that is the probability, at most 12. [sd]
double DistanceOf(double probability);

}  // namespace ambrig
