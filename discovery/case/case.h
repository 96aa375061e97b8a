#pragma once
/// A case: measurements beside the model that should explain them. Format: docs/guide/files.md.
#include <map>
#include <string>
#include <vector>

#include "core/record/record.h"
#include "discovery/case/bench_tables.h"
#include "discovery/case/data_quality.h"
#include "scenarios/scenario.h"

namespace ambrig {

/// Where a channel of a record comes from.
struct ColumnSource {
  std::string column, si;  // its name in the data file; the channel's SI unit
  double factor = 1;       // SI per number in the file
};

/// What of a record over time is taken from its data instead of being predicted.
enum class Imposed {
  kNothing,
  kMotion,    // measured positions move the gaps: no rotor, no controller
  kCurrents,  // measured currents drive the rotor: no circuits, no controller
};

struct CaseRecord {
  RecordKind kind = RecordKind::kTime;
  std::string scenario_file, data_file;  // no scenario file: hover, or a held rotor
  Scenario scenario;
  // rig channel names, SI; of a frequency response or a table every value over its sd, one row a
  // point
  Record data;
  ResponseTable responses;  // of kind kFrf, as measured
  StaticTable table;        // of kind kStatic, as measured
  bool validate = false;    // kept from the fits; "test" records are too
  bool test = false;        // also kept from every choice of a search (test_records.h)
  Imposed imposed = Imposed::kNothing;
  double observer = 20;  // [Hz] with imposed currents: how fast the rotor follows the measured one
  std::vector<ChannelQuality> quality;  // one per channel of data
  std::map<std::string, ColumnSource> sources;
  double time_offset = 0;  // [s] scenario time of the logger's zero
  // [s] of rows after the scenario's end that were cut off: more than a logger stopped late has,
  // without an offset
  double behind = 0;
  // [s] last row before and first one behind each block of rows that the logger lost and the case
  // does not leave out
  std::vector<std::pair<double, double>> gaps = {};
};

/// Standard deviations of what may differ from record to record; 0: it may not.
struct NuisancePriors {
  std::map<std::string, double> sensor_zero;  // by channel [m], [A]
  double time_shift = 0;                      // [s]
  double input_gain = 0;                      // of all commanded signals [-]
  bool any() const { return !sensor_zero.empty() || time_shift > 0 || input_gain > 0; }
};

struct Case {
  std::string file, rig_file;
  RigParameters rig;
  std::map<std::string, double> noise;  // rms by channel, SI
  NuisancePriors nuisances;
  std::vector<CaseRecord> records;
  std::vector<std::string> notes;  // what the data-quality pass left out
};

/// @throws InputError, one line, for anything that contradicts.
Case ReadCase(const std::string& path);

}  // namespace ambrig
