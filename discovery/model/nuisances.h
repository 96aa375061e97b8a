#pragma once
/// What may differ from record to record without being physics that the model lacks: zeros of
/// sensors and loggers, a slow drift, a shift of the clock, the size of the commanded signals. Each
/// is a column over the rows of one record; its amount has a Gaussian prior and is eliminated from
/// every residual and sensitivity alike, so that a fit never has to spend a parameter on it.
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "discovery/model/stretch_column.h"

namespace ambrig {

class CaseModel;
struct Hypothesis;
struct RigParameters;

/// A kind of nuisance: "zero of A.x", "logger zero of A.i1", "drift of A.x", "time shift", "input gain".
struct NuisanceKind {
  std::string name, group;  // group: sensor-zero | logger-zero | drift | time-shift | input-gain
  std::string unit;
  double sd = 0;         // prior, in `unit`
  StretchColumn column;  // of one sd, all rows of a model, over the floor
};

/// An amount found in one record.
struct NuisanceFound {
  std::string record, name, unit;
  double value = 0, sd = 0;
};

// names of the clock's and of the input's kind
inline constexpr const char* kTimeShift = "time shift";
inline constexpr const char* kInputGain = "input gain";

class Nuisances {
 public:
  /// `weight`: of a squared error over the floor, per row.
  void Use(const CaseModel& model, const std::vector<NuisanceKind>& kinds, double weight);
  bool any() const { return !records_.empty(); }
  /// How many amounts there are, of all records.
  std::size_t count() const;
  /// Takes off what the nuisances explain, record by record.
  void Eliminate(double* rows) const;
  void Eliminate(Eigen::MatrixXd& columns) const;
  /// The amounts in a residual from which nothing was taken off.
  std::vector<NuisanceFound> Amounts(const CaseModel& model,
                                     const std::vector<double>& residual) const;

 private:
  struct OfRecord {
    Eigen::Index first = 0, count = 0;
    std::size_t record = 0;
    Eigen::MatrixXd columns;            // rows of the record, of one sd each
    Eigen::LLT<Eigen::MatrixXd> solve;  // of columns'columns + 1/weight
    std::vector<std::size_t> kinds;     // of the columns
  };
  Eigen::VectorXd Fit(const OfRecord& r, const double* rows) const;
  std::vector<OfRecord> records_;
  std::vector<NuisanceKind> kinds_;
  double weight_ = 1;
};

/// Usual sd of the zero of a channel [its unit]; 0: it has none.
double UsualZero(const RigParameters& rig, const std::string& channel);

/// Every kind that the records could have, with the sd that the case declares or a usual one.
/// `model` holds all rows; `predicted` of `h`. Simulates each zero of a sensor inside the loop and
/// one change of the input's size.
std::vector<NuisanceKind> NuisanceKindsOf(const CaseModel& model, const Hypothesis& h,
                                          const std::vector<double>& predicted, bool declared_only);

/// The kinds seen by a model with fewer rows of the same case.
std::vector<NuisanceKind> Thinned(const std::vector<NuisanceKind>& kinds, const CaseModel& full,
                                  const CaseModel& thin);

}  // namespace ambrig
