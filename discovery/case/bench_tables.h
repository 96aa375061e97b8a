#pragma once
/// What a laboratory measures besides records over time: frequency responses and static tables.
/// Both are compared point by point, each over its own standard deviation.
#include <complex>
#include <string>
#include <vector>

#include "core/record/record.h"
#include "discovery/case/response_point.h"

namespace ambrig {

/// What kind of measurement a record of a case is; it decides who predicts it (record_predictor.h).
enum class RecordKind { kTime, kFrf, kStatic };

/// What a case says of a trace of a file of frequency responses: which response of the rig it is,
/// and what its instrument did to it. A value v of the file at f [Hz] is gain · conj?(|v| e^{i
/// phase_gain arg v}) · e^{2 pi i f late} in `unit`.
struct TraceMapping {
  std::string response, trace, unit, coherence, excited;
  double gain = 1;
  double phase_gain = 1;   // 180/pi: its phases are radians that were taken for degrees
  double late = 0;         // [s]
  bool conjugate = false;  // its phases have the opposite sign
};

struct RigResponse {
  ResponsePoint output, input;
  ResponsePoint excited;                     // the port that was driven; the input where it is one
  std::string unit;                          // SI, of output over input
  std::vector<std::complex<double>> values;  // SI
  // of the real and of the imaginary part [SI]; only in proportion where not `sd_known`
  std::vector<double> sd;
  bool sd_known = false;
  TraceMapping from = {};  // what the case says of the file
  std::string name() const { return output.name + "/" + input.name; }
};

struct ResponseTable {
  std::vector<double> frequency;  // [Hz]
  double frequency_gain = 1;      // over the file's
  std::vector<RigResponse> responses;
};

/// Standard deviation of the real and of the imaginary part of an estimate H with coherence g2 over
/// n = `averages` averages:  |H| sqrt((1 - g2) / (2 (n - 2) g2)).  Infinite where nothing is
/// coherent. Source: Bendat and Piersol, Random Data, 4th ed., table 9.6, with n - 2 for n: a
/// coherence of few averages is an estimate too, so that the squared error over that of the table
/// is F distributed with 2 and 2 (n - 1) degrees of freedom, with mean n/(n - 2). At least n/2.
double CoherenceSd(double magnitude, double g2, double averages);

/// Rows of a table: positions and currents that were set, force or impedance that was read.
struct StaticTable {
  // "A.x" [m], "A.i1" [A], "frequency" [Hz]: what is left out is the scenario's, or 0
  std::vector<Channel> inputs;
  // "A.fx" [N], "A.L1" [H], "A.lambda1" [Wb], "A.L1@1000" [H] and "A.R1@1000" [ohm] at 1000 Hz
  std::vector<Channel> outputs;
  std::vector<std::vector<double>> sd;  // of each output, per row
  std::vector<char> sd_known;           // per output
};

/// Input of a table: the frequency of the meter in each row [Hz].
inline constexpr const char* kFrequencyColumn = "frequency";

/// What stands behind the '@' of an output's name [Hz]; 0 without one, NaN if it is no number above
/// 0.
double MeterFrequency(const std::string& output);

}  // namespace ambrig
