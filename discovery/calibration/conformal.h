#pragma once
/// Sets that hold the right answer with a stated probability, whatever the probabilities are worth
/// (split conformal prediction; Vovk, Gammerman and Shafer 2005). Practice cases give scores
///   s_i = 1 - p(right answer)
/// and a name e of score s_e is in the set of level 95 % when
///   (1 + #{s_i >= s_e})/(n + 1) > 0.05
/// It holds for cases that are sampled like the practice cases.
#include <vector>

namespace ambrig {

/// p-value of a score among those of the practice cases.
double ConformalPValue(const std::vector<double>& scores, double score);

/// The least probability that a name must have to be in the set of `level`: 1 less the largest
/// score whose p-value is above 1 - level; 0 where every name is in it (too few cases, or too many
/// whose right answer had no probability).
double LeastProbabilityOfSet(const std::vector<double>& scores, double level);

}  // namespace ambrig
