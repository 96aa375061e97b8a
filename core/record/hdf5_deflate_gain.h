#pragma once
/// Whether compressing a channel pays. Readings with noise in every digit lose a tenth to a quarter
/// of their size to deflate, for a tenth of the time of the run that made them; means of converter
/// readings and constants lose half of it and more.
#include <vector>

namespace ambrig {

/// Whether the first 2048 samples, shuffled as HDF5's filter does (first bytes of all samples,
/// then the second ones), lose a third of their size to deflate. The same samples give
/// the same answer.
bool DeflatePays(const std::vector<double>& samples);

}  // namespace ambrig
