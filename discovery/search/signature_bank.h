#pragma once
/// Signatures of probes once simulated: what each changes in all channels, over the floor. A later
/// round ranks the same effects against a new residual without simulating them again.
#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "discovery/search/fit.h"
#include "discovery/search/probes.h"

namespace ambrig {

/// Products over the rows of the fit records and over those of the unseen ones.
struct Gram {
  Eigen::MatrixXd fit, validate;
};

class SignatureBank {
 public:
  struct Entry {
    ProbeGroup group;        // only the probes that the rotor survived
    Eigen::Index first = 0;  // column of its first probe
    Eigen::Index count() const { return static_cast<Eigen::Index>(group.probes.size()); }
  };

  /// Simulates the groups' probes on top of `base` and adds their signatures.
  void Simulate(const CaseModel& model, const FitResult& base,
                const std::vector<ProbeGroup>& groups,
                const std::function<void(double, const std::string&)>& progress);

  const std::vector<Entry>& entries() const { return entries_; }
  bool Holds(const EffectInstance& probe) const;
  /// columnsᵀ columns, n x n.
  const Gram& Products(const CaseModel& model);
  /// aᵀ columns, for a with the model's rows.
  Gram ProductsWith(const CaseModel& model, const Eigen::MatrixXd& a) const;

 private:
  std::vector<Entry> entries_;
  Eigen::MatrixXf columns_;  // spare columns at the end
  Eigen::Index used_ = 0, multiplied_ = 0;
  Gram products_;
};

/// aᵀ b over the rows of both kinds.
Gram RowProducts(const CaseModel& model, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace ambrig
