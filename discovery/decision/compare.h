#pragma once
/// The model beside the measurement: error per channel, record and block, over the noise floor.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "discovery/data_gate/data_gate.h"
#include "discovery/model/block_ratios.h"
#include "discovery/model/residual.h"

namespace ambrig {

struct ChannelError {
  std::string channel;
  // [-]: rms error over the rms of the data about its mean, nan for data that do not move; [SI unit
  // of the channel], twice: rms error and noise floor; [-]: rms error over the floor
  double nrmse = 0, rms_error = 0, noise = 0, ratio = 0;
  double whiteness = 0;  // correlation of neighbouring residuals, 0: white
};

struct RecordComparison {
  std::string data, scenario;
  bool validate = false, test = false;  // as CaseRecord
  std::vector<ChannelError> channels;
  BlockErrors blocks;
  double ratio = 0;  // [-] rms over the floor, all channels; nan: nothing counts
  std::vector<std::string> frequencies;  // where the error stands out
};

struct Comparison {
  std::vector<DataFault> data;  // gross errors of the data
  NoiseModel noise;
  std::vector<RecordComparison> records;
  // [-] of all, fitted, validation records; nan where no row of them counts
  double ratio = 0, ratio_fit = 0, ratio_validate = 0;
  std::vector<std::string> words;           // the worst places, named
  std::vector<double> predicted, residual;  // rows of the model: [SI]; over the floor [-]
  double effective_sample_size = 0;         // independent numbers among the residuals
  std::vector<SampleSpan> unpredictable;    // left out of the model
  std::vector<std::string> left_out;        // single samples among them, a line for each column
};

/// @throws InputError where no row of any record counts.
Comparison Compare(CaseModel& model, const Hypothesis& h, bool blocks = true,
                   const std::function<void(double, const std::string&)>& progress = {});

}  // namespace ambrig
