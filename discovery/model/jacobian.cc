#include "discovery/model/jacobian.h"

namespace ambrig {

Eigen::MatrixXd Jacobian(const CaseModel& model, const Hypothesis& h,
                         const std::vector<std::size_t>& parameters, double fraction,
                         const QuickLook* look) {
  std::vector<Hypothesis> moved;
  std::vector<double> change;
  for (std::size_t p : parameters) {
    Hypothesis m = h;
    const double at = h.Coordinate(p);
    m.Set(p, h.ValueAt(p, at + fraction));
    // at its upper bound
    if (m.free[p].value == h.free[p].value) m.Set(p, h.ValueAt(p, at - fraction));
    change.push_back(m.Coordinate(p) - at);
    moved.push_back(std::move(m));
  }
  moved.push_back(h);
  const auto runs = model.PredictAll(moved, ModelFidelity::kCoarse, look);
  const auto& here = runs.back();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model.size()),
                                            static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t c = 0; here && c < parameters.size(); ++c) {
    if (!runs[c] || change[c] == 0) continue;
    for (const Target& t : model.targets())
      for (std::size_t k = t.first; k < t.first + t.count; ++k)
        if (model.ok()[k])
          J(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) =
              ((*runs[c])[k] - (*here)[k]) / t.floor / change[c];
  }
  if (model.nuisances.any()) model.nuisances.Eliminate(J);
  return J;
}

}  // namespace ambrig
