#pragma once
/// Which records of a case are simulated where many trials are compared: those that hold the error.
#include "discovery/search/fit.h"

namespace ambrig {

/// The one or two fitted records of free rotors with the largest error of `now`; all records where
/// none has any.
RecordSubset WorstRecords(const CaseModel& model, const FitResult& now);

/// Whether a response of a free rotor shows an error: a hover beside it, which nothing excites,
/// tells nothing of it.
bool ResponsesShowError(const CaseModel& model, const FitResult& now);

/// The records that together hold nine tenths of the error above the noise, of the fitted and of
/// the unseen ones each. All records where the error is hardly above the noise: then each may
/// count. Beside effects that were adopted an effect has to explain most of what is left, which the
/// records that hold it show.
RecordSubset RecordsShowing(const CaseModel& model, const FitResult& now);

}  // namespace ambrig
