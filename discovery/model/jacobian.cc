#include "discovery/model/jacobian.h"

#include <cmath>
#include <optional>

#include "discovery/model/in_parallel.h"
#include "discovery/model/residual.h"

namespace ambrig {

namespace {

/// The parameter moved by `fraction` of a step, back where its bound is in the way. The change of
/// its coordinate; 0: it cannot move.
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

// Changes of a prediction, rms over the rows in noise floors. A step that makes more is taken again
// with one that should make the wanted change: over more than that a prediction is no straight line
// (where a loop nears its limit, one sd of a leakage inductance changed it ten times as much as its
// slope says), over much less its jumps, some hundredths of the floor, are divided by little.
constexpr double kMostChange = 3, kWantedChange = 1;
constexpr double kLeastStep = 0.01, kStepOfLost = 0.1;  // of the first one; where it lost the rotor
constexpr int kTimesLost = 3;

/// rms of the change over the rows of the records looked at, in floors.
double ChangeOf(const CaseModel& model, const RecordSubset* look, const Prediction& here,
                const Prediction& moved) {
  double sum = 0, rows = 0;
  for (const Target& t : model.targets()) {
    if (look && !look->records[t.record]) continue;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      if (!model.ok()[k]) continue;
      sum += std::pow(((*moved)[k] - (*here)[k]) / t.floor, 2);
      ++rows;
    }
  }
  return rows > 0 ? std::sqrt(sum / rows) : 0;
}

/// Rows of one column: a prediction and the change of the coordinate that made it.
void FillColumn(const CaseModel& model, const Prediction& here, const Prediction& moved,
                double change, Eigen::MatrixXd::ColXpr column) {
  if (!moved || change == 0) return;
  ChangeOverFloor(model, *here, *moved, column.data());
  DropJumps(model, column.data());
  column /= change;
}

}  // namespace

Eigen::MatrixXd Jacobian(const CaseModel& model, const Hypothesis& h,
                         const std::vector<std::size_t>& parameters, double fraction,
                         const RecordSubset* look, DifferenceSides differences) {
  const std::size_t n = parameters.size(),
                    sides = differences == DifferenceSides::kTwoSided ? 2 : 1;
  std::vector<Hypothesis> moved(sides * n + 1, h);
  std::vector<double> change(sides * n);
  const auto move = [&](std::size_t k, Hypothesis& to, double share) {
    change[k] = Move(to, parameters[k % n], share * (k < n ? fraction : -fraction));
  };
  for (std::size_t k = 0; k < sides * n; ++k) move(k, moved[k], 1);
  auto runs = model.PredictAll(moved, ModelFidelity::kCoarse, look);
  const Prediction here = std::move(runs.back());
  std::vector<std::size_t> far;  // steps that are taken again
  std::vector<Hypothesis> nearer;
  std::vector<double> sizes(sides * n);
  InParallel(here ? sizes.size() : 0, [&](std::size_t k) {
    sizes[k] = runs[k] ? ChangeOf(model, look, here, runs[k]) : kInfinity;
  });
  for (std::size_t k = 0; here && k < sides * n; ++k) {
    const double size = sizes[k];
    if (change[k] == 0 || size <= kMostChange) continue;
    far.push_back(k);
    nearer.push_back(h);
    move(k, nearer.back(), runs[k] ? std::max(kLeastStep, kWantedChange / size) : kStepOfLost);
  }
  double share = kStepOfLost;
  for (int time = 0; time < kTimesLost && !far.empty(); ++time) {
    auto again = model.PredictAll(nearer, ModelFidelity::kCoarse, look);
    std::vector<std::size_t> lost;
    for (std::size_t k = 0; k < far.size(); ++k) {
      if (!again[k]) lost.push_back(far[k]);
      runs[far[k]] = std::move(again[k]);
    }
    // a usual size is far too large for a small rig
    share *= kStepOfLost;
    far = std::move(lost);
    nearer.assign(far.size(), h);
    for (std::size_t k = 0; k < far.size(); ++k) move(far[k], nearer[k], share);
  }
  const auto rows = static_cast<Eigen::Index>(model.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(n));
  InParallel(here ? n : 0, [&](std::size_t c) {
    const auto i = static_cast<Eigen::Index>(c);
    FillColumn(model, here, runs[c], change[c], J.col(i));
    // at a bound both sides are the same one
    if (sides == 1 || !runs[c] || !runs[n + c] || change[c] * change[n + c] >= 0) return;
    Eigen::MatrixXd back = Eigen::MatrixXd::Zero(rows, 1);
    FillColumn(model, here, runs[n + c], change[n + c], back.col(0));
    for (Eigen::Index row = 0; row < rows; ++row)
      J(row, i) = SmallerOfOneSign(J(row, i), back(row, 0));
  });
  if (model.nuisances.any()) model.nuisances.Eliminate(J, look ? &look->records : nullptr);
  return J;
}

}  // namespace ambrig
