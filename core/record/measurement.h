#pragma once
/// What the file of an instrument holds: a record over time, frequency responses, or both.
#include <complex>
#include <string>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

struct MeasuredResponse {
  std::string name;  // "A.x/A.fx": response over reference, as far as the file says
  std::string unit;  // of the response, or of response over reference
  std::vector<std::complex<double>> values;
};

/// Coherence of a response, 0 to 1: the part of its output that its input explains.
struct MeasuredCoherence {
  std::string name;  // of the response; empty: of all in the file
  std::vector<double> values;
};

/// Frequency responses on one axis.
struct FrequencyResponses {
  std::vector<double> frequency = {};  // [Hz]; empty: the file does not say
  std::vector<MeasuredResponse> responses = {};
  std::vector<MeasuredCoherence> coherence = {};

  std::size_t points() const { return responses.empty() ? 0 : responses.front().values.size(); }
};

struct Measurement {
  Record record = {};  // without channels: nothing over time; notes also of the responses
  FrequencyResponses frequency = {};
};

/// Frequencies are finite, not negative, and increase. @throws InputError starting with `where`
void CheckFrequencies(const std::vector<double>& frequencies, const std::string& where);

/// Equal lengths, frequencies that increase; names and units as UTF-8.
/// @throws InputError starting with `where`
void CheckResponses(FrequencyResponses& responses, const std::string& where);

}  // namespace ambrig
