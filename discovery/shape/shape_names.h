#pragma once
/// Names judged by their laws in a free shape: those of the iron and of forces of the motion. The
/// catalogue's laws have one or two numbers, real iron follows none of them exactly, and what the
/// one number misses may be larger than what tells two names apart: eddy currents in a closed ring
/// (first order) are followed better by a narrow hysteresis loop than by half-order diffusion.
/// Where names of iron are contested, or the best leaves more than noise, the shape of each law is
/// fitted (discovery/shape/shape_fit.h), and the errors that remain then decide. Method:
/// docs/theory/discovery.md, step 5.
#include "discovery/search/effect_round.h"

namespace ambrig {

/// Fits free shapes of the iron's laws at the bearing of the best-ranked name of iron, in the first
/// round also of forces of the motion where they stand, and ranks again. Eddy currents that were
/// not ranked join where their shape is the best of all and a fit of the catalogue's law has a
/// size. `now` has `round` effects already.
void JudgeByShape(const RoundSetting& setting, const FitResult& now, int round,
                  std::vector<RankedEffect>& ranking);

}  // namespace ambrig
