#pragma once
/// Signatures of probes once simulated: what each changes in all channels, over the floor. A later
/// round ranks the same effects against a new residual without simulating them again.
#include <Eigen/Dense>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discovery/search/fit.h"
#include "discovery/search/probes.h"

namespace ambrig {

/// Products over the rows of the fit records and over those of the unseen ones; the part of either
/// that points of records which are not over time have in them (empty without such records).
struct Gram {
  Eigen::MatrixXd fit, validate;
  Eigen::MatrixXd fit_points, validate_points;
  static Gram Zero(const CaseModel& model, Eigen::Index rows, Eigen::Index cols);
};

class SignatureBank {
 public:
  struct Entry {
    ProbeGroup group;                        // only the probes that the rotor survived
    Eigen::Index first = 0;                  // column of its first probe
    std::shared_ptr<const Hypothesis> base;  // what its probes stand on
    Eigen::Index count() const { return static_cast<Eigen::Index>(group.probes.size()); }
  };

  /// Simulates the groups' probes on top of `base` and adds their signatures. With a bank limited
  /// to some records the others' rows are zero.
  void Simulate(const CaseModel& model, const FitResult& base,
                const std::vector<ProbeGroup>& groups,
                const std::function<void(double, const std::string&)>& progress);
  /// Signatures of the records of `look` only, until more are asked for: what the bank lacks of
  /// them is then simulated.
  void LookAt(const CaseModel& model, const RecordSubset& look);
  /// Floors have changed from those of `before` (the same targets), and rows may have stopped to
  /// count.
  void Rescale(const CaseModel& model, const std::vector<Target>& before);
  /// The model has nuisances since the signatures were taken: what these explain is taken off.
  void TakeOffNuisances(const CaseModel& model);
  /// Whether some record was left out.
  bool partial() const;

  /// Whether the rows of half of these records or more are yet to be simulated: to take all
  /// signatures anew then costs little more.
  bool LacksHalfOf(const RecordSubset& look) const;

  /// Whether the signatures hold this record's rows.
  bool LooksAt(std::size_t record) const { return !look_ || look_->records[record]; }
  /// The entry's signatures, each by its amount.
  Eigen::VectorXd Sum(const Entry& entry, const Eigen::VectorXd& amount) const;

  const std::vector<Entry>& entries() const { return entries_; }
  bool Holds(const EffectInstance& probe) const;
  /// columnsᵀ columns, n x n.
  const Gram& Products(const CaseModel& model);
  /// aᵀ columns, for a with the model's rows.
  Gram ProductsWith(const CaseModel& model, const Eigen::MatrixXd& a) const;

 private:
  /// Fills rows of the look's records into the columns of the entries begin to end, of one base.
  void Fill(const CaseModel& model, std::size_t begin, std::size_t end, const RecordSubset& look);
  /// The columns are others now.
  void ForgetProducts();
  /// Probes with which the rotor is lost, taken again with less of what they move (`rows`: of each
  /// probe's table, -1: it stays). A usual size may be far too large for a small rig.
  void TakeSmaller(const CaseModel& model, const Hypothesis& base, const std::vector<int>& rows,
                   std::vector<EffectInstance>& probes,
                   std::vector<std::vector<float>>& signatures) const;
  /// The signature of each probe on one base; empty: the rotor is lost.
  std::vector<std::vector<float>> Signatures(const CaseModel& model, const Hypothesis& base,
                                             const std::vector<EffectInstance>& probes,
                                             const RecordSubset* look) const;

  std::vector<Entry> entries_;
  std::optional<RecordSubset> look_;
  Eigen::MatrixXf columns_;  // spare columns at the end
  Eigen::Index used_ = 0, multiplied_ = 0;
  Gram products_;
};

/// aᵀ b over the rows of both kinds.
Gram RowProducts(const CaseModel& model, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace ambrig
