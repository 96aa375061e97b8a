#pragma once
/// The measurement noise of a case, channel by channel: stated by the case or the rig file,
/// estimated from the records, and used. What is used goes round the model's control loop.
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

class CaseModel;
struct Hypothesis;

/// rms, SI units of the channel; nan: not stated, not to be estimated.
struct ChannelNoise {
  double stated = std::numeric_limits<double>::quiet_NaN();
  double estimated = std::numeric_limits<double>::quiet_NaN();
  double used = 0;
  double rows_per_number =
      1;  // rows that are worth one independent number: more than one of filtered noise
};

struct NoiseModel {
  std::map<std::string, ChannelNoise> channels;
  // of one ADC sample of a coil current [A]; nan: the rig file's
  double current_sample = std::numeric_limits<double>::quiet_NaN();
  bool estimated = false;

  /// What is used of a channel; nan: nothing known of its own.
  double Used(const std::string& channel) const;
  /// Rows of a channel's own noise that are worth one independent number, at least 1.
  double RowsPerNumber(const std::string& channel) const;
};

/// What the case states; where it does not, what the rig file states.
NoiseModel StatedNoise(const RigParameters& rig, const std::map<std::string, double>& of_case);

/// The rig with this noise in its sensors, its current measurement and its bus.
RigParameters WithNoise(const RigParameters& rig, const NoiseModel& noise);

/// Estimates the noise of every position, load cell, bus and current column from the differences
/// between records and prediction (discovery/data/noise_estimate.h). A stated noise is kept when it
/// agrees with the estimate within a factor of 1.5, or is larger and no record has a smaller error.
/// Noise that is the same in all stretches of the records but not white counts as a whole
/// (filtered_noise.h); else, and where none is stated, the estimate is used. The noise of coil
/// currents is told from what reaches them through the set-points by two simulations, with much and
/// with little of it. `model` holds all rows. Without a prediction the stated noise is returned.
NoiseModel EstimateNoise(const CaseModel& model, const Hypothesis& h);

/// One line for every channel whose stated noise is not believed or was not stated.
std::vector<std::string> NoiseRemarks(const NoiseModel& noise);

}  // namespace ambrig
