#pragma once
/// The page of two runs compared: what differs, and both curves of the channels that differ most.
#include <string>
#include <vector>

#include "app/json/difference_json.h"

namespace ambrig {

struct DifferencePage {
  std::string name;
  const RunFiles *a = nullptr, *b = nullptr;
  const RunDifference* difference = nullptr;
};

/// @throws InputError when the file cannot be written.
void WriteDifferenceReport(const std::vector<DifferencePage>& runs, const std::string& path);

}  // namespace ambrig
