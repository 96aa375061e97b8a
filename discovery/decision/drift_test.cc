#include "discovery/decision/drift_test.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/math/chi_squared.h"

namespace ambrig {

namespace {

// Of a parameter's shift: records of hardly any noise tell it more finely than the laws of two
// simulators, let alone of a rig, agree.
constexpr double kLawsDiffer = 0.05;

/// The value that 99 of 100 chi-squared numbers with this freedom do not exceed.
double ChiSquared99(int freedom) {
  constexpr double kNormal = 2.3263;
  return freedom * QuantileOfMeanSquare(freedom, kNormal);
}

}  // namespace

DriftTest TestDrift(const std::vector<double>& value, const std::vector<double>& weight,
                    double sd) {
  DriftTest out;
  double total = 0, mean = 0, most = 0;
  for (const double w : weight) most = std::max(most, w);
  std::vector<std::pair<double, double>> seen;  // value, weight
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (weight[k] < 1e-6 * most || weight[k] <= 0) continue;  // does not see the parameter
    seen.emplace_back(value[k], 1 / (1 / weight[k] + sd * sd));
    total += seen.back().second;
    mean += seen.back().second * value[k];
  }
  if (seen.size() < 2) return out;
  mean /= total;
  for (const auto& [v, w] : seen) out.q += w * std::pow(v - mean, 2);
  out.freedom = static_cast<int>(seen.size()) - 1;
  out.holds = out.q <= ChiSquared99(out.freedom);
  return out;
}

DriftTest TestDrift(const CaseModel& model, const FitResult& fit, std::size_t parameter,
                    double weight) {
  std::map<std::size_t, std::pair<double, double>> of_record;  // J'J, J'r
  const auto column = fit.jacobian.col(static_cast<Eigen::Index>(parameter));
  for (const Target& t : model.targets()) {
    auto& [square, product] = of_record[t.record];
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      const double j = column(static_cast<Eigen::Index>(k));
      square += j * j;
      product += j * fit.residual[k];
    }
  }
  std::vector<double> value, information;
  for (const auto& [record, sums] : of_record) {
    value.push_back(sums.first > 0 ? sums.second / sums.first : 0);
    information.push_back(weight * sums.first);
  }
  const bool of_rig = fit.hypothesis.free[parameter].sd > 0;
  const double shift = of_rig ? fit.hypothesis.Coordinate(parameter) : 0;  // [sd]
  return TestDrift(value, information, kLawsDiffer * shift);
}

}  // namespace ambrig
