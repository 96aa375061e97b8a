#pragma once
/// Maximum-a-posteriori fit of a hypothesis to the fit records: errors over the noise floor, rig
/// parameters under their Gaussian prior, bounds kept (Ceres, Levenberg-Marquardt). The door to
/// Ceres. The weight of the errors follows the ratio reached (discovery/search/likelihood.h) and
/// is renewed from pass to pass.
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "discovery/model/jacobian.h"
#include "discovery/model/residual.h"

namespace ambrig {

struct FitOptions {
  int iterations = 4;  // of each pass
  // Each with a new weight, about the point where the last one ended. With `sensitivities` those of
  // the rig parameters are taken again in the second pass, later where a parameter moved by more
  // than 1 sd.
  int passes = 4;
  // At the start of a pass: how far a step is believed. A small one shortens most the steps along
  // valleys where an effect and rig parameters stand in for each other.
  double trust_region = 10;
  double tolerance = 1e-3;  // of the cost: a step that gains less is the last
  // of what a pass gained so far: a step that gains less, and little, is its last; 0: the tolerance
  // alone decides
  double least_share = 0;
  // of 2 log posterior: a pass that gains less is the last; 0: one that lowers the ratio by less
  // than 2 %
  double least_gain = 0;
  bool sensitivities = true;  // sd, warnings and Jacobian at the optimum
  DifferenceSides differences = DifferenceSides::kOneSided;  // of the sensitivities
  double effective_sample_size = 1;  // independent numbers among the residuals
  // ratio_fit of a hypothesis within this one: what the errors are weighed by when the start is
  // worse
  double reached = kInfinity;
  // its first columns: the rig parameters, for the first pass
  const Eigen::MatrixXd* base_jacobian = nullptr;
  // so many of the first free parameters keep its columns throughout, effects among them: for one
  // short pass that tries a further effect beside those which have their place already
  std::size_t lent = 0;
  // a flag for each record: the fit looks at these only (of the fitted ones); empty: at all of them
  std::vector<char> records = {};
};

struct FitResult {
  Hypothesis hypothesis;  // at the optimum
  // rows of the model: predicted values [SI unit of the channel]; measured less predicted over the
  // floor [-]
  std::vector<double> predicted, residual;
  std::vector<double> sd;  // of the free parameters, their own units
  // the same of an effect's sizes with the shape of its law held: what tells whether it is there
  std::vector<double> size_sd;
  // of the last fit: sd of the free parameters over what they are by noise alone [-]
  std::vector<double> doubt;
  double ratio_fit = 0, ratio_validate = 0;  // [-] rms over the floor: fitted, validation records
  // Σ (shift/sd)² of the rig parameters, what lies beyond 3 sd counted five times
  double penalty = 0;
  bool converged = false;
  std::vector<std::string> warnings;  // at a bound, without influence, strongly correlated
  // rows of the model x free parameters: d(prediction/floor)/d(coordinate of the parameter) [-]
  Eigen::MatrixXd jacobian;

  /// Whether the model could be followed at all: a rotor that is lost at the start leaves no errors
  /// to judge by.
  bool Stands() const { return !residual.empty(); }
};

/// A fit that finds no better point says so (`converged` false), it never passes for a result.
FitResult Fit(const CaseModel& model, const Hypothesis& start, const FitOptions& options);

/// Whether the fit holds effects that the rig file does not: later rounds stand on such fits.
bool HoldsAdopted(const CaseModel& model, const FitResult& fit);

/// Adds the prior's part to the information on the free parameters (n x n, in their coordinates); a
/// little where there is no prior, so that what the records do not tell has a finite sd.
void AddPriorInformation(const Hypothesis& h, Eigen::MatrixXd& information);

/// Fitted values and sd of the effect number `index` of the hypothesis.
EffectInstance FittedEffect(const FitResult& fit, std::size_t index);

}  // namespace ambrig
