#pragma once
/// A column over all rows of a model that is zero except in some stretches of rows. Copies share
/// their values.
#include <Eigen/Dense>
#include <memory>
#include <vector>

namespace ambrig {

class StretchColumn {
 public:
  explicit StretchColumn(Eigen::Index rows = 0) : rows_(rows) {}
  /// All rows in one stretch.
  explicit StretchColumn(Eigen::VectorXd values);

  Eigen::Index rows() const { return rows_; }
  /// `values` from row `first` on: behind every stretch that there is, and within the rows.
  void Append(Eigen::Index first, Eigen::VectorXd values);

  // Rows `first` to first + count - 1.
  Eigen::VectorXd Segment(Eigen::Index first, Eigen::Index count) const;
  double SquaredNorm(Eigen::Index first, Eigen::Index count) const;
  /// The product with `others`, which holds all rows.
  double Dot(Eigen::Index first, Eigen::Index count, const Eigen::VectorXd& others) const;

 private:
  struct Stretch {
    Eigen::Index first = 0;
    std::shared_ptr<const Eigen::VectorXd> values;
    Eigen::Index end() const { return first + values->size(); }
  };
  /// Calls `use(row, values)` with the part of every stretch that lies in these rows.
  template <class Use>
  void ForEach(Eigen::Index first, Eigen::Index count, const Use& use) const;

  Eigen::Index rows_ = 0;
  std::vector<Stretch> stretches_;  // in the order of their rows
};

}  // namespace ambrig
