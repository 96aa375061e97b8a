#pragma once
/// The assignment of rows to columns with the least sum of costs.
#include <Eigen/Core>
#include <vector>

namespace ambrig {

/// Column of each row of a square matrix of finite costs, every column once, so that the sum is
/// least. Source: H. W. Kuhn, Naval Res. Logist. Q. 2 (1955); shortest augmenting paths, O(n^3).
std::vector<std::size_t> LeastAssignment(const Eigen::MatrixXd& cost);

}  // namespace ambrig
