#pragma once
/// What a synthesis is told of the bending modes that it models: how far each may ring, and how
/// well its frequency is known.
///
///   eta'' + ... + w² (1 + d)² eta = ...,  |d| <= uncertainty:
///     the error 2 d w² eta acts as a force on the mode
///
/// Per mode and plane of motion: an output eta/eta_0 in the cost and a disturbing modal force 2
/// uncertainty w² eta_0 among the disturbances. The product of both is the gain of the uncertain
/// loop (small gain theorem); eta_0, the amplitude at which the shaft deflects by `deflection`
/// where the mode is largest, shares it between them. Without it the observer takes each frequency
/// for exact and cancels resonances that lie elsewhere. Source: Zhou, Doyle, Glover 1996, chapters
/// 9, 10; Schweitzer, Maslen 2009, chapter 12.
#include "core/base/parameters.h"

namespace ambrig {

struct ModeWeight {
  double deflection = 1e-4;
  double uncertainty = 0.01;
};

inline constexpr Field<ModeWeight> kModeWeightFields[] = {
    {"deflection", &ModeWeight::deflection, "m", 1e-9, 1e3,
     "largest deflection of a bending mode with unit cost"},
    {"uncertainty", &ModeWeight::uncertainty, "-", 0, 0.5,
     "relative error of the modes' frequencies"},
};

}  // namespace ambrig
