#pragma once
/// When an effect is believed, and what the verdict is.
#include "discovery/decision/verdict.h"
#include "discovery/search/fit.h"
#include "discovery/search/stage_ratios.h"

namespace ambrig {

/// Whether the shifts of the rig parameters are what their sd allow: Σ (shift/sd)² not above 2.2
/// times their number (of 11, once in a hundred). Above it an effect may hide in an impossible
/// parameter.
bool Believable(const FitResult& fit);

/// Whether tolerances alone make such shifts more than once in a thousand: what the verdict asks,
/// when no effect was found that would bring them back.
bool Possible(const FitResult& fit);

/// Whether the step from `before` to `after` (one more effect) is more than chance and more than a
/// patch: `round` counts the effects adopted before it, `first_fall` is how far the first one
/// brought the squared ratio down. What a law leaves in detail must not be sold as a second effect:
/// that one has to explain most of what is left, or to weigh against the first. An effect that
/// brings unbelievable parameters back to where they may be is adopted for that alone.
bool WorthAdopting(const FitResult& before, const FitResult& after, double score_gain, int round,
                   double first_fall);

/// Whether one effect leaves nothing but noise, on unseen records too, where no other candidate
/// gains a tenth as much: what nuisances leave of their own kind is closed a little by several.
/// Asked beside nuisances that nobody declared. `score_gain`, `next_gain`: of the score, by this
/// candidate and by the best of the others.
bool ClosesAlone(const FitResult& before, const FitResult& after, double score_gain,
                 double next_gain);

/// What the rig parameters had to do to explain the records alone.
struct ParameterNeed {
  double largest_shift = 0;  // of its own sd [-]
  bool possible = true;      // all shifts together, see Possible
  bool constant = true;      // those beyond 3 sd are the same in every record (drift test)
};

/// What the search for effects ended with: none that was worth adopting, one whose name stays in
/// doubt, one that stands.
enum class FoundEffect { kNone, kDoubtful, kEstablished };

/// Effect, parameters, none or unknown. Every record counts, fitted or not. An effect that
/// was established is named whatever remains; five sd are never parameters, three only where the
/// records agree on the shift. Parameters that leave a trace are the verdict only where no effect
/// explains it.
ExplanationVerdict VerdictOf(const StageRatios& nominal, const StageRatios& base,
                             const ParameterNeed& need, FoundEffect found);

}  // namespace ambrig
