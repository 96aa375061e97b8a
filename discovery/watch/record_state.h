#pragma once
/// What one record says of its rig, and how it differs from what an earlier record of the same
/// experiment said: each is compared and fitted alone, so that both share the errors of the model
/// that have nothing to do with time.
#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "discovery/case/case.h"
#include "discovery/data_gate/data_gate.h"

namespace ambrig {

struct StateParameter {
  std::string path, unit;  // "bearings.A.gap"
  double value = 0, sd = 0;
};

struct RecordState {
  std::vector<DataFault> faults;  // gross errors of the data: nothing is fitted then
  double ratio = 0;               // error over noise, with the parameters of the reference
  double ratio_fitted = 0;        // with its own
  double explained = 0;  // share of the error above the noise that its own parameters explain
  double effective_sample_size = 0;
  std::map<std::string, double> noise;  // rms by channel, as used [SI]
  std::map<std::string, double>
      floors;  // error over noise by channel, with the reference's parameters
  std::vector<StateParameter> parameters;
};

/// Of the only record of `c`. `reference`: the state of the earlier record, whose parameters are
/// what the fit expects; nullptr: this is the reference. @throws Interrupted
RecordState StateOf(const Case& c, const RecordState* reference, const std::atomic<bool>* stop);

/// Something that left the band in which it stays with a probability of 99 % if nothing changed.
struct LeftBand {
  std::string kind;  // parameter | error | noise | channel: one that no longer says anything
  std::string name;  // path of the parameter, channel; "" for the error
  std::string unit;
  double value = 0, was = 0;
  double sds = 0;                  // of a parameter: its change over the sd of the change
  double least = 0, greatest = 0;  // the band
};

/// Sd that the largest of `count` numbers keeps within with a probability of 99 %.
double BandWidth(std::size_t count);

/// The band of a parameter around the reference: the sd of both, BandWidth of all.
LeftBand ParameterBand(const StateParameter& now, const StateParameter& was, std::size_t count);

/// What left its band, largest change first.
std::vector<LeftBand> FindLeftBands(const RecordState& now, const RecordState& reference);

}  // namespace ambrig
