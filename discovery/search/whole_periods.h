#pragma once
/// Parameters of effects that act in whole switching periods: a prediction has steps there and no
/// slope in between.
#include "discovery/model/case_model.h"

namespace ambrig {

/// The switching period [s] if the parameter acts in whole ones (EffectDescription::whole_periods);
/// 0: it does not.
double WholePeriodOf(const CaseModel& model, const Hypothesis& h, const FreeParameter& parameter);

}  // namespace ambrig
