#pragma once
/// Frequency responses and static tables of a case, measured and by the model.
#include <vector>

#include "app/figures/figure.h"
#include "app/figures/residual_figures.h"

namespace ambrig {

/// One figure per response (magnitude, phase, error over its sd) or per quantity of a table (value
/// over the input that was varied most, error over its sd). None for a record over time.
std::vector<Figure> BenchFigures(const CaseModel& model, const std::vector<NamedPrediction>& models,
                                 std::size_t record);

}  // namespace ambrig
