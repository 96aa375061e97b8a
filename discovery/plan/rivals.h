#pragma once
/// The names that are left, each as a fitted model with what is known of its numbers: what a next
/// record should tell apart.
#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "discovery/search/fit.h"

namespace ambrig {

struct Rival {
  std::string effect, target;  // "nothing", "" without an effect
  Hypothesis hypothesis;       // at its best point so far
  Eigen::MatrixXd precision;   // of the free parameters' coordinates, from prior and records so far
  Eigen::MatrixXd drawn;       // the same for the models that records are simulated with
  std::string Name() const { return target.empty() ? effect : effect + " at " + target; }
};

/// What one record would show of one rival, over the floor.
struct RivalView {
  std::vector<double> predicted;
  Eigen::MatrixXd columns;  // sensitivities of its free parameters, then law variations
  Eigen::MatrixXd weight;   // prior precision of all columns
};

/// A model of one possible record, its floors set.
struct TrialRecord {
  std::unique_ptr<Case> data;
  std::unique_ptr<CaseModel> model;
  double row_weight = 1;  // of a squared error over the floor
};

/// The effect's law is known to about this share only: its signature may differ by as much in every
/// eighth of a record.
inline constexpr double kLawVariation = 0.15;
inline constexpr int kLawBlocks = 8;

/// `nothing`: prediction of the model without the rivals' effects. False when the rotor is lost.
bool ViewOf(const TrialRecord& trial, const Rival& rival, const std::vector<double>& nothing,
            RivalView* view);

/// Squared distance of two rivals' predictions in standard deviations, whatever their numbers and
/// laws do to come nearer: min over b of |d - C b|² + bᵀ P b.
double SquaredDistance(const TrialRecord& trial, const RivalView& a, const RivalView& b);

/// -2 ln of the evidence of a record under a rival, constants left out. `data`: rows of the trial.
double Disbelief(const TrialRecord& trial, const RivalView& view, const std::vector<double>& data);

/// Probability that the nearer of two models is the right one at a squared distance.
double ProbabilityRight(double squared_distance);

}  // namespace ambrig
