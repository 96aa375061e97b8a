#pragma once
/// What differs without being physics that the model lacks. From record to record: zeros of sensors
/// and loggers, a slow drift, a shift of the clock, the size of the commanded signals; each is a
/// column over the rows of one record. From machine to machine: the errors of single coils whose
/// spread the rig file states (discovery/model/coil_errors.h), the same in all records. The amounts
/// have a Gaussian prior and are eliminated from every residual and sensitivity alike, so that a
/// fit never has to spend a parameter on them.
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "discovery/model/nuisance_group.h"
#include "discovery/model/stretch_column.h"
#include "discovery/model/target.h"

namespace ambrig {

class CaseModel;

/// A kind of nuisance: "zero of A.x", "logger zero of A.i1", "drift of A.x", "time shift", "input
/// gain", "current gain of A.i1", "edge of A.i1".
struct NuisanceKind {
  std::string name;
  NuisanceGroup group = NuisanceGroup::kSensorZero;
  std::string unit;
  double sd = 0;                // prior, in `unit`
  StretchColumn column;         // of one sd, all rows of a model, over the floor
  bool in_all_records = false;  // one amount for all records; else one for each
  std::string coil = {};        // whose error it is, "A.coil3"; empty: not one of a single coil
};

/// An amount found in one record, or in all of them.
struct NuisanceFound {
  std::string record;  // its data file; empty: all records
  std::string name, unit;
  double value = 0, sd = 0;
  NuisanceGroup group = NuisanceGroup::kSensorZero;  // as its kind's, and the coil
  std::string coil = {};
};

// names of the clock's and of the input's kind
inline constexpr const char* kTimeShift = "time shift";
inline constexpr const char* kInputGain = "input gain";

class Nuisances {
 public:
  /// `weight`: of a squared error over the floor, per row; `weight_in_all` where the amounts of all
  /// records are estimated: less beside an effect that is still missing, which would pass for
  /// errors of the coils.
  void Use(const CaseModel& model, const std::vector<NuisanceKind>& kinds, double weight,
           double weight_in_all);
  void Use(const CaseModel& model, const std::vector<NuisanceKind>& kinds, double weight) {
    Use(model, kinds, weight, weight);
  }
  const std::vector<NuisanceKind>& kinds() const { return kinds_; }
  bool any() const { return !records_.empty() || !in_all_.kinds.empty(); }
  /// Whether some amounts are the same in all records.
  bool in_all() const { return !in_all_.kinds.empty(); }
  /// Whether some amounts differ from record to record.
  bool differ() const { return !records_.empty(); }
  /// How many amounts there are that differ from record to record.
  std::size_t count() const;
  /// Takes off what the nuisances explain. `records`: a flag for each record, the rows of the
  /// others are not known; null: of none.
  void Eliminate(double* rows, const std::vector<char>* records = nullptr) const;
  void Eliminate(Eigen::MatrixXd& columns, const std::vector<char>* records = nullptr) const;
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
  /// Amounts that all records share, estimated from the fitted ones. There they are not taken off
  /// whole: rows are multiplied by the inverse square root of their covariance 1 + weight G G', so
  /// that squares of rows hold the price of amounts that are unlikely. From unseen records the
  /// estimate is taken off.
  struct InAll {
    Eigen::MatrixXd columns;  // G: all rows, of one sd each; the amounts of the records eliminated
    struct Span {
      Eigen::Index first = 0, count = 0;
      std::size_t record = 0;
      bool fitted = true;
      Eigen::MatrixXd normal;  // G'G of its rows
    };
    std::vector<Span> spans;
    std::vector<std::size_t> kinds;  // of the columns
  };
  /// For what the fitted ones of some records tell.
  struct Weighing {
    Eigen::MatrixXd shrink;   // K: fitted rows become rows - G K G' rows
    Eigen::MatrixXd inverse;  // of G'G + 1/weight
  };
  static bool Tells(const InAll::Span& span, const std::vector<char>* records) {
    return span.fitted && (!records || (*records)[span.record]);
  }
  /// Whether no fitted record is left out: then the weighing is the one that is kept.
  bool AllTell(const std::vector<char>* records) const;
  Weighing WeighingOf(const std::vector<char>* records) const;
  /// G' rows of what the records tell.
  Eigen::VectorXd Product(const double* rows, const std::vector<char>* records) const;
  void EliminateInAll(double* rows, const std::vector<char>* records,
                      const Weighing& weighing) const;
  void UseRecord(const CaseModel& model, std::size_t record);
  void UseInAll(const CaseModel& model);
  Eigen::VectorXd Fit(const OfRecord& r, const double* rows) const;
  void EliminateRecords(double* rows) const;
  std::vector<OfRecord> records_;
  InAll in_all_;
  Weighing weighing_;  // of all fitted records
  std::vector<NuisanceKind> kinds_;
  double weight_ = 1, weight_in_all_ = 1;
};

/// The kinds over the floors that the model has now. `before`: its targets while the columns were
/// taken over their floors; of a model of the same case.
std::vector<NuisanceKind> OverNewFloors(const std::vector<NuisanceKind>& kinds,
                                        const CaseModel& model, const std::vector<Target>& before);

/// The kinds seen by a model with fewer rows of the same case.
std::vector<NuisanceKind> Thinned(const std::vector<NuisanceKind>& kinds, const CaseModel& full,
                                  const CaseModel& thin);

}  // namespace ambrig
