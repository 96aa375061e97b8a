#pragma once
/// How much an error over the floor speaks against a hypothesis. Noise of known size would give n
/// (R² - 1) with n independent numbers. What a law leaves in detail is no noise: it hangs together
/// over whole records, so of the excess R² - 1 only about 300 numbers are independent. The two
/// parts together weigh each squared error
///   w(R) = n/(1 + (R² - 1) n/300)   and, integrated over R²,   300 ln(1 + (R² - 1) n/300).
/// At the noise floor that is the full likelihood; far above it a rig parameter is not dragged to
/// where nobody would believe it just to patch an effect that is missing.
#include "discovery/search/fit.h"

namespace ambrig {

inline constexpr double kModelNumbers = 300;  // independent numbers in what a wrong law leaves

/// -2 log likelihood of a ratio R to the floor, `n` independent numbers.
double Misfit(double ratio, double n);
/// Its derivative to R².
double MisfitWeight(double ratio, double n, double model_numbers = kModelNumbers);
/// The weight of the square of one row over its floor, of a model that leaves `ratio`.
double RowWeight(const CaseModel& model, double ratio, double n,
                 double model_numbers = kModelNumbers);

/// Numbers of one effect that count: the higher harmonics of a profile are no free choice each.
int PricedParameters(int count);

/// Misfit of both kinds of records, the prior's penalty of the rig parameters and the price of
/// `parameters` more numbers: smaller is better. `effective_sample_size`: independent numbers among
/// the residuals; not more count than the floor itself is known by, and below the floor nothing is
/// better.
double Score(const CaseModel& model, double ratio_fit, double ratio_validate,
             double effective_sample_size, int parameters, double penalty);
/// Of a fit, with a price per kind of effect.
double Score(const CaseModel& model, const FitResult& fit, double effective_sample_size);

/// Probabilities of laws that exclude each other, from their scores and the shares of the error
/// above the noise that they explain (0 to 1), best score first. Where the best leaves a part 1
/// - s, no law of the list is exact, and the same law with other details would explain s ± 0.35
/// (1 - s): laws whose shares differ by no more than that are not told apart, whatever their
/// likelihoods say. `extras`: numbers of each law that only shape it further. They give it room
/// that the others do not have, so where the shares decide each counts against it.
std::vector<double> Probabilities(const std::vector<double>& scores,
                                  const std::vector<double>& shares,
                                  const std::vector<int>& extras);

}  // namespace ambrig
