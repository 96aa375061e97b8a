#pragma once
/// Figures 4, 5 and 11 to 20 of the paper of the slope detector, redrawn from simulated records
/// (simulation/paper_bench/paper_study.h). Figure 16 shows the load; here it is a table of the
/// page.
#include "app/figures/figure.h"
#include "simulation/paper_bench/paper_study.h"

namespace ambrig {

Figure PaperFigure4(const PaperStudy& study);
Figure PaperFigure5(const PaperStudy& study);
Figure PaperFigure11(const PaperStudy& study);

/// Of one fault: the waveform in its stages (12, 17), the sampling points (13, 18), the range of
/// slopes (14, 19), the flag (15, 20).
Figure PaperWaveform(const PaperRun& run, int number);
Figure PaperSamplingPoints(const PaperRun& run, int number);
Figure PaperSlopeRange(const PaperRun& run, int number);
Figure PaperFlag(const PaperRun& run, int number);

}  // namespace ambrig
