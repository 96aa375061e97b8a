#pragma once
/// Errors of a prediction against the data, in units of the noise floor.
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// (measured - predicted)/floor; 0 where a sample does not count. With a `look` its records only
/// were predicted.
std::vector<double> Residual(const CaseModel& model, const std::vector<double>& predicted,
                             const RecordSubset* look = nullptr);

/// The amounts of the nuisances of `model` in what this prediction leaves.
std::vector<NuisanceFound> AmountsOfNuisances(const CaseModel& model,
                                              const std::vector<double>& predicted);

/// (to - from)/floor of two predictions into all rows of `out`; 0 where a sample does not count.
void ChangeOverFloor(const CaseModel& model, const std::vector<double>& from,
                     const std::vector<double>& to, double* out);

enum class Which { kFit, kValidate, kAll };
bool Counts(const CaseModel& model, const Target& t, Which which);
/// The number of rows of a target that count.
double CountedRows(const CaseModel& model, const Target& t);

/// @throws InputError where no row of any record counts: no answer can be given, least of all
/// agreement.
void RequireCountedRows(const CaseModel& model);

/// Independent numbers that an error over the floor of records over time is known by at most: their
/// floor comes from two runs with noise, known to about 1 % of its power.
inline constexpr double kFloorNumbers = 1e4;

/// Errors over the floor of records over time, and of responses and tables, whose points have a
/// standard deviation each and are independent.
struct ErrorSums {
  double square = 0, rows = 0;           // over time: Σ r², rows that count
  double square_points = 0, points = 0;  // likewise
};
/// How many rows over time one point counts as where both are averaged: rows are so many that the
/// uncertainty of their floor would hide what the points say. Points count in full, all rows
/// together as kFloorNumbers at most.
double WorthOfPoint(const CaseModel& model);
/// rms over the floor of both kinds. Neither makes good what the other leaves: below the floor
/// counts as the floor where both are there. 0 where nothing counts.
double RatioOf(const ErrorSums& sums, double worth_of_point);

/// Root mean square of a residual over the chosen records: 1 means nothing is left but noise. 0
/// where no row counts.
double Ratio(const CaseModel& model, const std::vector<double>& residual, Which which);
/// The same for a reader: not a number where no row counts.
double KnownRatio(const CaseModel& model, const std::vector<double>& residual, Which which);
/// Of the unseen records; where there are none, of the fitted ones.
double UnseenRatio(const CaseModel& model, const std::vector<double>& residual);
double TargetRatio(const CaseModel& model, const std::vector<double>& residual, const Target& t);
/// Error of one record: Σ r² and the number of the rows that count.
struct RecordError {
  std::size_t record = 0;
  double square = 0, rows = 0;
};
std::vector<RecordError> RecordErrors(const CaseModel& model, const std::vector<double>& residual);
/// Largest ratio of any single record.
double WorstRecordRatio(const CaseModel& model, const std::vector<double>& residual);
/// A reading or a set-point of a free rotor's record over time, or a response of a free rotor.
bool ShowsMotion(const CaseModel& model, const Target& t);
/// Largest ratio of the readings and set-points of any record of a free rotor: what moves the rotor
/// reaches the currents through these only. 0 without such records.
double WorstMotionRatio(const CaseModel& model, const std::vector<double>& residual);
/// Largest ratio of any single channel.
double WorstRatio(const CaseModel& model, const std::vector<double>& residual, Which which);

}  // namespace ambrig
