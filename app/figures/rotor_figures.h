#pragma once
/// Of the rotor in its bearings, over speed and along the shaft, in the report of `ambrig analyze`.
#include "analysis/rig_analysis.h"
#include "app/figures/figure.h"

namespace ambrig {

Figure CampbellFigure(const RigAnalysis& a);     // frequencies and log decrements over speed
Figure ModeShapeFigure(const RigAnalysis& a);    // at the highest operating speed
Figure RotorModeFigure(const RigAnalysis& a);    // free and on springs
Figure CriticalMapFigure(const RigAnalysis& a);  // undamped critical speed map
Figure UnbalanceFigure(const RigAnalysis& a, const UnbalanceSweep& sweep);

}  // namespace ambrig
