#include "discovery/model/jacobian.h"

#include <cmath>
#include <optional>

namespace ambrig {

namespace {

/// The parameter moved by `fraction` of a step, back where its bound is in the way. The change of its
/// coordinate; 0: it cannot move.
double Move(Hypothesis& h, std::size_t parameter, double fraction) {
  const double at = h.Coordinate(parameter);
  for (const double by : {fraction, -fraction}) {
    Hypothesis moved = h;
    moved.Set(parameter, h.ValueAt(parameter, at + by));
    if (moved.free[parameter].value == h.free[parameter].value) continue;
    const double change = moved.Coordinate(parameter) - at;
    h = std::move(moved);
    return change;
  }
  return 0;
}

double SmallerOfOneSign(double a, double b) {
  if (a * b <= 0) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

using Prediction = std::optional<std::vector<double>>;

/// Rows of one column: a prediction and the change of the coordinate that made it.
void FillColumn(const CaseModel& model, const Prediction& here, const Prediction& moved,
                double change, Eigen::MatrixXd::ColXpr column) {
  if (!moved || change == 0) return;
  for (const Target& t : model.targets())
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      if (model.ok()[k])
        column(static_cast<Eigen::Index>(k)) = ((*moved)[k] - (*here)[k]) / t.floor / change;
}

}  // namespace

Eigen::MatrixXd Jacobian(const CaseModel& model, const Hypothesis& h,
                         const std::vector<std::size_t>& parameters, double fraction,
                         const QuickLook* look, DifferenceSides differences) {
  const std::size_t n = parameters.size(),
                    sides = differences == DifferenceSides::kTwoSided ? 2 : 1;
  std::vector<Hypothesis> moved;
  std::vector<double> change;
  for (std::size_t side = 0; side < sides; ++side)
    for (std::size_t p : parameters) {
      moved.push_back(h);
      change.push_back(Move(moved.back(), p, side == 0 ? fraction : -fraction));
    }
  moved.push_back(h);
  const auto runs = model.PredictAll(moved, ModelFidelity::kCoarse, look);
  const auto& here = runs.back();
  const auto rows = static_cast<Eigen::Index>(model.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(n));
  for (std::size_t c = 0; here && c < n; ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    FillColumn(model, here, runs[c], change[c], J.col(i));
    // at a bound both sides are the same one
    if (sides == 1 || !runs[c] || !runs[n + c] || change[c] * change[n + c] >= 0) continue;
    Eigen::MatrixXd back = Eigen::MatrixXd::Zero(rows, 1);
    FillColumn(model, here, runs[n + c], change[n + c], back.col(0));
    for (Eigen::Index row = 0; row < rows; ++row)
      J(row, i) = SmallerOfOneSign(J(row, i), back(row, 0));
  }
  if (model.nuisances.any()) model.nuisances.Eliminate(J);
  return J;
}

}  // namespace ambrig
