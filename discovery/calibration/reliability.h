#pragma once
/// Whether stated probabilities are true: reliability diagram, expected calibration error, shares
/// with their uncertainty.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ambrig {

/// A statement: this is right with `probability`; and whether it was.
struct JudgedStatement {
  double probability = 0;
  bool right = false;
};

/// Statements of one interval of probability, lo < p <= hi (the first one holds 0 too).
struct ReliabilityBin {
  double lo = 0, hi = 0;
  std::size_t count = 0;
  double stated = 0, found = 0;  // mean probability; share that was right
};

/// `bins` intervals of equal width over [0, 1]; empty ones too.
std::vector<ReliabilityBin> ReliabilityDiagram(const std::vector<JudgedStatement>& all, int bins);

struct CalibrationError {
  double value = 0;      // Σ count/n |found - stated|
  double sd = 0;         // over resampled statements (bootstrap)
  double by_chance = 0;  // mean of what true probabilities would give with as many statements
};

/// Expected calibration error over `bins` intervals (Naeini et al. 2015). A few statements give a
/// value above 0 by chance alone, which `by_chance` tells; 400 draws each, of `seed`.
CalibrationError ExpectedCalibrationError(const std::vector<JudgedStatement>& all, int bins,
                                          std::uint64_t seed = 1);

struct Share {
  std::size_t right = 0, of = 0;
  double value = 0, lo = 0, hi = 1;
};

/// right/of with Wilson's interval of 95 % (Wilson 1927); of nothing: 0 to 1.
Share ShareOf(std::size_t right, std::size_t of);

}  // namespace ambrig
