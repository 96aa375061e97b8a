#include "discovery/search/size_sd.h"

#include <cmath>

#include "core/math/linear_equations.h"
#include "effects/catalogue.h"

namespace ambrig {

using Eigen::Index;

namespace {

/// A parameter of an effect's law that is no size of it (a frequency, a time constant).
bool IsShape(const FreeParameter& p, const Hypothesis& h) {
  if (p.effect < 0) return false;
  const EffectInstance& e = h.rig.effects[static_cast<std::size_t>(p.effect)];
  const EffectDescription* d = FindEffect(e.name);
  return d && !d->Switches(e.table[p.row]);
}

}  // namespace

std::vector<double> SdOfSizes(const Hypothesis& h, const Eigen::MatrixXd& information) {
  std::vector<double> sd(h.free.size(), 0);
  for (int effect = 0; effect < static_cast<int>(h.rig.effects.size()); ++effect) {
    std::vector<Index> rows;
    for (std::size_t k = 0; k < h.free.size(); ++k)
      if (h.free[k].effect != effect || !IsShape(h.free[k], h))
        rows.push_back(static_cast<Index>(k));
    const Eigen::MatrixXd part = information(rows, rows);
    const Eigen::MatrixXd covariance =
        SolveSymmetricColumns(part, Eigen::MatrixXd::Identity(part.rows(), part.cols()));
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (h.free[static_cast<std::size_t>(rows[r])].effect == effect)
        sd[static_cast<std::size_t>(rows[r])] =
            std::sqrt(std::max(0.0, covariance(static_cast<Index>(r), static_cast<Index>(r))));
  }
  return sd;
}

}  // namespace ambrig
