#pragma once
/// The noise floor of records that are no records over time: frequency responses and tables, whose
/// values stand over their sd already.
#include "discovery/model/case_model.h"

namespace ambrig {

/// Of target number `target` of such a record: 1 where the sd is known. Else the sd holds in
/// proportion only, and its size is the white part of what `predicted` misses along the points (of
/// a response real and imaginary part together), at least what cannot be told apart.
double PointFloor(const CaseModel& model, std::size_t target, const std::vector<double>& predicted);

}  // namespace ambrig
