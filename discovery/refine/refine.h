#pragma once
/// The law's shape, once the effect is named: the catalogue's law is fitted first, then replaced by
/// a free shape (discovery/shape/shape.h), and the result stands in a new rig file. Method:
/// docs/theory/refine.md.
#include <memory>
#include <string>
#include <vector>

#include "discovery/explain/explain.h"
#include "discovery/shape/shape_fit.h"

namespace ambrig {

struct CurvePoint {
  double u = 0, value = 0, sd = 0, support = 0;
  double named = 0;      // the catalogue's law, as fitted
  bool visited = false;  // the records drive the law there
};

struct Refinement {
  std::string effect, target;  // as named
  Shape shape;
  ShapeFit fit;
  std::vector<CurvePoint> curve;
  // over the noise floor: the catalogue's law and the refined one, on unseen records (on all where
  // there are none) and on fitted ones
  double ratio_before = 0, ratio_after = 0, ratio_fit_before = 0, ratio_fit_after = 0;
  bool any_unseen = false;
  double supported_lo = 0, supported_hi = 0;  // longest stretch of u that is visited and supported
  std::vector<LadderStep> ladder;
  std::vector<double> residual_before, residual_after;  // all rows of `model`
  std::vector<std::string> warnings;
  std::string rig_text;
  std::unique_ptr<const Case> seen;  // that of `model` where the case has records of the test
  std::unique_ptr<CaseModel> model;  // all rows, floors set
};

/// Supported: the records remove this share of the prior variance.
inline constexpr double kSupported = 0.75;

/// `target` "": where the named effect explains most. `output`: name of the new rig file in errors.
/// @throws InputError
Refinement Refine(const Case& c, const std::string& effect, const std::string& target,
                  const std::string& output, const ExplainOptions& options);

}  // namespace ambrig
