#pragma once
#include <string>
#include <vector>

#include "app/figures/figure.h"

namespace ambrig {

/// Cells of error over noise: the colour runs from the noise to at most ten times it, so that one
/// extreme does not whiten the rest; numbers are printed where there is room for them.
Figure RatioFigure(const std::vector<std::string>& columns, const std::vector<std::string>& rows,
                   const std::vector<std::vector<double>>& values, const std::string& caption,
                   double scale = 0);

}  // namespace ambrig
