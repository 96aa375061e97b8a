#pragma once
/// Stretches of rows that follow each other and all count, for spectra.
#include <cstddef>
#include <vector>

#include "discovery/model/target.h"

namespace ambrig {

class CaseModel;

struct RowStretch {
  const Target* target = nullptr;
  std::size_t first = 0, length = 0;  // rows in the flat vectors
};

/// Stretches of 1024 rows of these channels, one behind the other; of 512 or 256 where there are
/// fewer than `fewest`. Empty: there are fewer even then.
std::vector<RowStretch> StretchesOf(const CaseModel& model, const std::vector<const Target*>& of,
                                    std::size_t fewest);

}  // namespace ambrig
