#pragma once
/// A column of the data that a fit compares.
#include <cstddef>

namespace ambrig {

/// One channel of one record as data of a fit.
struct Target {
  std::size_t record = 0, channel = 0;  // into case.records[].data.channels
  std::size_t first = 0, count = 0;     // rows in the flat vectors
  double floor = 1;                     // rms that noise alone makes
  double full_scale = 0;                // rms of the data about its mean
  double independent = 0;  // numbers that a row of its record is worth, at most 1; 0: not known
};

}  // namespace ambrig
