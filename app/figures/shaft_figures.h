#pragma once
/// Figures of a shaft on supports, in the report of `ambrig analyze`.
#include "analysis/shaft/shaft_analysis.h"
#include "app/figures/figure.h"

namespace ambrig {

Figure ShaftFigure(const ShaftAnalysis& a);  // outline, disks, supports
/// At the highest operating speed, drawn in space; a button lets them turn.
Figure ShaftModesFigure(const ShaftAnalysis& a);
Figure WeightFigure(const ShaftAnalysis& a);  // deflection, shear, moment
Figure RodFigure(const ShaftAnalysis& a);     // axial and torsional modes
/// Long half axis and phase of x at the probes, force of the supports.
Figure ShaftResponseFigure(const ShaftAnalysis& a, const ShaftSweep& sweep);
/// Orbits of the probes at the largest peak, or at the highest operating speed where none is.
Figure ShaftOrbitFigure(const ShaftAnalysis& a, const ShaftSweep& sweep);
Figure HarmonicFigure(const HarmonicSweep& sweep);
/// Bands of the response to one case of unbalance over the rotors drawn.
Figure ScatterFigure(const ShaftAnalysis& a, const std::string& unbalance);
Figure CouplingFigure(const Level1& level1);

}  // namespace ambrig
