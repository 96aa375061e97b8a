#pragma once
/// Predictions of some records of a case only, where the others cannot have changed or do not
/// matter.
#include <vector>

namespace ambrig {

/// A prediction of some records only (one flag each): the rows of the others are those of `rest`.
struct RecordSubset {
  std::vector<char> records;
  std::vector<double> rest;
};

}  // namespace ambrig
