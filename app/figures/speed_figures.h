#pragma once
/// Figures of a run whose speed changes: waterfall and order tracks (core/math/order_tracking.h).
#include <optional>

#include "app/figures/figure.h"
#include "app/figures/run_data.h"

namespace ambrig {

/// Whether the speed changes enough to tell what turns with the shaft from what does not.
bool SpeedVaries(const RunReportData& data);

/// Amplitude over frequency and time for each plane, forward above, backward below; the shaft's own
/// frequency as a line.
Figure WaterfallFigure(const RunReportData& data);

/// Orders 1 and 2 forward and order 1 backward over the speed, a panel per plane. Nothing where no
/// window holds enough turns.
std::optional<Figure> OrderFigure(const RunReportData& data);

}  // namespace ambrig
