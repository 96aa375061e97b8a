#pragma once
/// A rig parameter that stands in for a missing effect takes another value in every record: each
/// record is asked for its own correction of one parameter, and the corrections are compared.
#include <vector>

#include "discovery/search/fit.h"

namespace ambrig {

struct DriftTest {
  double q = 0;       // sum over the records of (correction - mean)^2 / variance
  int freedom = 0;    // records that see the parameter, minus 1
  bool holds = true;  // q within what 99 of 100 constant parameters show
};

/// Corrections `value` with information `weight` (1/variance) of each record; `sd` by which records
/// differ whatever they tell, in the unit of the values.
DriftTest TestDrift(const std::vector<double>& value, const std::vector<double>& weight,
                    double sd = 0);

/// Of the free parameter number `parameter` of a fit with sensitivities, all records, which may
/// differ by a twentieth of the shift of a rig parameter.
/// `weight`: of a squared error over the floor, per row (MisfitWeight over the rows).
DriftTest TestDrift(const CaseModel& model, const FitResult& fit, std::size_t parameter,
                    double weight);

}  // namespace ambrig
