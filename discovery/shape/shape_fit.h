#pragma once
/// The sizes of a shape fitted to the fit records beside the rig parameters: Gauss-Newton with a
/// penalty on the roughness whose weight is chosen by the evidence, limits kept (sizes are not
/// negative), every step confirmed by simulation.
#include <functional>

#include "discovery/search/fit.h"
#include "discovery/shape/shape.h"

namespace ambrig {

struct ShapeFit {
  FitResult fit;              // the hypothesis with the shape as its last effect, without sd
  std::vector<double> sizes;  // of the shape, own units
  // covariances, sizes x sizes, products of the sizes' own units: what the records and the penalty
  // leave, and what the penalty alone does
  Eigen::MatrixXd posterior, prior;
  std::vector<double>
      influence;         // of each size [-]: information of the records times its prior variance
  double smoothing = 0;  // lambda [-] of the penalty |D c|², c in steps
  int iterations = 0;

  /// sd of the curve at u, and the share of its prior variance that the records remove, 0 to 1.
  double CurveSd(const Shape& shape, double u) const;
  double Support(const Shape& shape, double u) const;
};

struct ShapeFitOptions {
  double effective_sample_size = 1;  // independent numbers among the residuals
  std::function<void(double, const std::string&)> progress = {};
  // of the rig parameters and effects of the base, kept throughout; null: taken at the start and
  // once more
  const Eigen::MatrixXd* base_jacobian = nullptr;
  bool describe = true;  // posterior, prior and influence of the sizes
};

/// `base`: what is believed, without the effect that the shape replaces.
ShapeFit FitShape(const CaseModel& model, const Hypothesis& base, const Shape& shape,
                  const ShapeFitOptions& options);

/// The hypothesis without effect number `index`.
Hypothesis WithoutEffect(const Hypothesis& h, std::size_t index);

}  // namespace ambrig
