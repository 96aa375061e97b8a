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
  /// The same and the frequencies of the mains, without those whose lines (with their third and
  /// fifth harmonics) hold so little of the error that no tone there could explain much.
  std::map<std::string, std::vector<double>> tones;
  std::vector<double> spectrum;  // any phase [Hz], strongest first

  /// Whether a look at this plane found that the lines of no tone hold enough.
  bool ShowsNoTone(const std::string& plane) const {
    const auto found = tones.find(plane);
    return found != tones.end() && found->second.empty();
  }
};

/// Adds those of `more` that have no neighbour in the list within this ratio (its logarithm).
void AppendApart(std::vector<double>& list, const std::vector<double>& more, double ratio);
/// These frequencies and those of the mains.
std::vector<double> WithMains(std::vector<double> frequencies);

/// `model` with all rows and its residual over the floor.
ResidualPeaks FindPeaks(const CaseModel& model, const std::vector<double>& residual);

}  // namespace ambrig
