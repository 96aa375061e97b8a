#include "discovery/data/assignment.h"

#include <limits>

namespace ambrig {

std::vector<std::size_t> LeastAssignment(const Eigen::MatrixXd& cost) {
  const auto n = static_cast<std::size_t>(cost.rows());
  // Prices of rows u and of columns v with cost - u - v >= 0, 0 for what is assigned. Row and
  // column 0 are outside.
  std::vector<double> u(n + 1), v(n + 1);
  std::vector<std::size_t> row_of(n + 1, 0), from(n + 1);
  for (std::size_t row = 1; row <= n; ++row) {
    std::vector<double> slack(n + 1, std::numeric_limits<double>::infinity());
    std::vector<char> visited(n + 1, 0);
    std::size_t column = 0;
    row_of[0] = row;
    do {
      visited[column] = 1;
      double least = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t j = 1; j <= n; ++j) {
        if (visited[j]) continue;
        const double reduced =
            cost(static_cast<Eigen::Index>(row_of[column] - 1), static_cast<Eigen::Index>(j - 1)) -
            u[row_of[column]] - v[j];
        if (reduced < slack[j]) slack[j] = reduced, from[j] = column;
        if (slack[j] < least) least = slack[j], next = j;
      }
      for (std::size_t j = 0; j <= n; ++j)
        if (visited[j])
          u[row_of[j]] += least, v[j] -= least;
        else
          slack[j] -= least;
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = from[column]) row_of[column] = row_of[from[column]];
  }
  std::vector<std::size_t> out(n);
  for (std::size_t j = 1; j <= n; ++j) out[row_of[j] - 1] = j - 1;
  return out;
}

}  // namespace ambrig
