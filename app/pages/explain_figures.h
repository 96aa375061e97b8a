#pragma once
/// Parts of the explain report that need the case's model: where the plain model failed and how
/// the found effect mends it.
#include "app/figures/residual_figures.h"
#include "app/pages/discovery_parts.h"

namespace ambrig {

/// The case's model with floors, and the prediction of the rig file as it is.
struct ExplainScene {
  ExplainScene(const Case& c, const Explanation& e);
  const Explanation& explanation;
  CaseModel model;
  std::vector<double> plain, plain_residual, final_prediction, final_residual, noise;
  bool usable = false;  // false: the rig file's model loses its rotor, there is nothing to draw
};

void AddPlainFailure(HtmlReport& report, const ExplainScene& scene);
/// Measured against the model without and with what was found, at the channels that gained most.
void AddWhyThatOne(HtmlReport& report, const ExplainScene& scene);
/// What is left after everything that was fitted.
void AddWhatIsLeft(HtmlReport& report, const ExplainScene& scene);

}  // namespace ambrig
