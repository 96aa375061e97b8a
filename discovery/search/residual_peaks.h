#pragma once
/// Frequencies at which an error stands out: where tones and resonances that the model lacks are
/// sought.
#include <map>
#include <string>
#include <vector>

#include "discovery/model/residual.h"

namespace ambrig {

struct ResidualPeaks {
  /// By plane ("rig": all of them), of the readings, same phase in every record. [Hz], strongest
  /// first.
  std::map<std::string, std::vector<double>> coherent;
  std::vector<double> spectrum;  // any phase [Hz], strongest first
};

/// `model` with all rows and its residual over the floor.
ResidualPeaks FindPeaks(const CaseModel& model, const std::vector<double>& residual);

}  // namespace ambrig
