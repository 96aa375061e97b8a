#pragma once
/// The noise of a channel from its own samples: differences of high order leave white noise and
/// remove everything that moves slowly against the sampling rate, a model's error included.
#include <cstddef>
#include <vector>

namespace ambrig {

/// Standard deviation of the white part of `error` (measured minus predicted, one value per sample
/// of a uniform time base) [unit of error]. Fourth differences have the variance 70 sigma^2; their
/// median absolute deviation ignores steps and edges. Samples with `ok` 0 are left out together
/// with the differences that they touch. nan when fewer than 32 differences remain.
/// Source: J. von Neumann et al., Ann. Math. Stat. 12 (1941) for differences; 1.4826 MAD for normal
/// noise.
double WhiteNoiseOf(const double* error, const char* ok, std::size_t count);

/// Value below which the share `part` (0 to 1) of the finite values lies [their unit]; nan when
/// there is none.
double QuantileOf(std::vector<double> values, double part);
/// Median of the values [their unit]; nan when there is none. Not finite ones do not count.
double MedianOf(std::vector<double> values);
/// Value below which a quarter of the values lie: of estimates that a model's error only enlarges.
double LowerQuartileOf(std::vector<double> values);

}  // namespace ambrig
