#pragma once
/// Two models of a case, of all its rows and of fewer, made ready for fits that are not those of explain.
#include "discovery/decision/compare.h"

namespace ambrig {

/// Rows of both models beside each other: every how manieth row a model of about `rows` rows needs.
std::size_t ThinningTo(const Case& c, std::size_t rows);

/// Gives both the noise, horizons and floors of the comparison with `nominal`, which is returned, and the nuisances that the
/// case declares.
Comparison PrepareModels(CaseModel& full, CaseModel& thin, const Hypothesis& nominal);

}  // namespace ambrig
