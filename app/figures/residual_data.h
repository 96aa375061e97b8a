#pragma once
/// What the discovery figures draw: one channel of one record, measured beside one or more models.
#include <string>
#include <vector>

#include "discovery/model/residual.h"

namespace ambrig {

/// "record-3" of "some/where/record-3.h5".
std::string ShortName(const std::string& data_file);

const std::string& ChannelName(const CaseModel& model, const Target& t);

struct ChannelView {
  std::string channel, record;
  double rate = 0, floor = 1;                        // [Hz], noise rms in SI
  std::vector<double> t, measured, model, residual;  // SI; NaN where a sample does not count
};
ChannelView ViewOf(const CaseModel& model, const std::vector<double>& predicted, const Target& t);

/// The `count` worst channels of a record, at most `per_kind` of one kind so that eight coils with
/// one cause do not hide a reading; none that stands less than 5 % above its noise, save the worst.
std::vector<Target> WorstTargets(const CaseModel& model, const std::vector<double>& residual,
                                 std::size_t record, std::size_t count, std::size_t per_kind = 2);

/// One realization of the noise alone, as it arrives in every row of the targets after its way
/// round the control loop: a noisy run less the noise-free one, sized to the floor. Empty when the
/// noisy run loses the rotor; white where noise does not reach a channel.
std::vector<double> NoiseSample(const CaseModel& model, const Hypothesis& h,
                                const std::vector<double>& clean);

/// Correlation of a series with itself `lag` rows later, lags 0 .. count - 1.
std::vector<double> Autocorrelation(const std::vector<double>& x, std::size_t count);

/// Zero where a value is not finite: for sums and transforms.
std::vector<double> Filled(const std::vector<double>& x);

}  // namespace ambrig
