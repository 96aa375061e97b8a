#include "fdd/learning/fit_grade.h"

#include <Eigen/Dense>

namespace ambrig {

namespace {

constexpr std::size_t kFewestBeside = 5;  // coils
constexpr int kPattern = 3;               // 1, cos, sin

/// z of rows first to last - 1, which stand beside each other, without what they have in common.
Eigen::VectorXd OwnErrors(const LinkageModel& nominal, const CommissioningRows& rows,
                          const CoilEquations& coils, const std::vector<double>& z,
                          std::size_t first, std::size_t last) {
  const auto count = static_cast<Eigen::Index>(last - first);
  const Eigen::VectorXd all = Eigen::Map<const Eigen::VectorXd>(z.data() + first, count);
  if (last - first < kFewestBeside) return all;
  Eigen::MatrixXd common(count, kPattern);
  for (Eigen::Index k = 0; k < count; ++k) {
    const CommissioningRow& r = rows.rows()[first + static_cast<std::size_t>(k)];
    const double drive =
        (r.voltage + coils.offset[r.coil] - coils.resistance[r.coil] * r.mean) * r.weight;
    common.row(k) << drive, drive * nominal.direction_x[r.coil],
        drive * nominal.direction_y[r.coil];
  }
  return all - common * common.colPivHouseholderQr().solve(all);
}

}  // namespace

double FitGrade(const LinkageModel& nominal, const CommissioningRows& rows,
                const CoilEquations& coils, const std::vector<double>& z) {
  double sum = 0, freedom = 0;
  for (std::size_t n = 0, end = 0; n < z.size(); n = end) {
    for (end = n + 1; end < z.size() && rows.Beside(end);) ++end;
    for (const double left : OwnErrors(nominal, rows, coils, z, n, end)) sum += HuberCost(left);
    freedom += static_cast<double>(end - n) - (end - n < kFewestBeside ? 0 : kPattern);
  }
  return sum / freedom;
}

}  // namespace ambrig
