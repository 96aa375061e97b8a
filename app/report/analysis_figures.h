#pragma once
/// The figures that a bearing engineer looks for in the report of `ambrig analyze`.
#include "analysis/rig_analysis.h"
#include "app/report/figure.h"

namespace ambrig {

Figure SensitivityFigure(const RigAnalysis& a);   // |S| with the zones of ISO 14839-3, per speed
Figure NyquistFigure(const RigAnalysis& a);       // loop gain round -1
Figure CampbellFigure(const RigAnalysis& a);      // frequencies and log decrements over speed
Figure RootLocusFigure(const RigAnalysis& a);     // poles over speed
Figure ModeShapeFigure(const RigAnalysis& a);     // at the highest operating speed
Figure RotorModeFigure(const RigAnalysis& a);     // free and on springs
Figure CriticalMapFigure(const RigAnalysis& a);   // undamped critical speed map
Figure UnbalanceFigure(const RigAnalysis& a, const UnbalanceSweep& sweep);
Figure StiffnessFigure(const RigAnalysis& a);     // k(ω), c(ω) of the bearings; the levitated rotor
Figure BodeFigure(const ResponseCurve& curve);

}  // namespace ambrig
