#pragma once
/// Of the rotor in its bearings, over speed and along the shaft, in the report of `ambrig analyze`.
#include "analysis/rig_analysis.h"
#include "app/figures/figure.h"

namespace ambrig {

/// Frequencies and log decrements over speed, up to `fastest` [rad/s].
Figure CampbellFigure(const std::vector<ModeTrack>& tracks,
                      const std::vector<DampedCritical>& criticals, double fastest,
                      const std::string& caption);
Figure CampbellFigure(const RigAnalysis& a);
/// Undamped critical speeds over the supports' stiffness; a vertical line per named stiffness
/// [N/m].
Figure CriticalMapFigure(const std::vector<CriticalMapRow>& map,
                         const std::vector<std::pair<std::string, double>>& lines,
                         const std::string& caption);
/// Shades the operating speeds [rad/s] in the first panel of a figure over rpm up to `fastest`
/// [rad/s] and says so in the caption; one speed is a line.
void MarkOperatingSpeeds(Figure& figure, double lowest, double highest, double fastest);
Figure ModeShapeFigure(const RigAnalysis& a);    // at the highest operating speed
Figure RotorModeFigure(const RigAnalysis& a);    // free and on springs
Figure CriticalMapFigure(const RigAnalysis& a);  // undamped critical speed map
Figure UnbalanceFigure(const RigAnalysis& a, const UnbalanceSweep& sweep);

}  // namespace ambrig
