#pragma once
/// Of the closed position loops, in the report of `ambrig analyze`.
#include "analysis/rig_analysis.h"
#include "app/figures/figure.h"

namespace ambrig {

Figure SensitivityFigure(const RigAnalysis& a);  // |S| with the zones of ISO 14839-3, per speed
Figure NyquistFigure(const RigAnalysis& a);      // loop gain round -1
Figure RootLocusFigure(const RigAnalysis& a);    // poles over speed
Figure StiffnessFigure(const RigAnalysis& a);  // k(ω), c(ω) of the bearings; the levitated rotor
Figure BodeFigure(const ResponseCurve& curve);

}  // namespace ambrig
