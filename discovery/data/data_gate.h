#pragma once
/// Errors of the data as hypotheses, tried before any fit: a wrong unit, sign, column, clock or
/// scenario changes what a logger wrote and nothing else, so that undoing it brings the column back
/// to the model's prediction. What the rig itself does differently changes other columns too and
/// is left to the fits. Only gross errors are named; method: docs/theory/data_gate.md.
#include <string>
#include <vector>

#include "discovery/data/signal_match.h"
#include "discovery/model/model.h"

namespace ambrig {

/// Floors above which an error of a column is gross; below it a fit may speak first.
inline constexpr double kGrossError = 10;

/// What is wrong with a whole column (DataFault::with).
inline constexpr const char *kEmpty = "empty", *kWholeColumn = "whole record";

struct DataFault {
  std::string record, channel;  // data file; "" for all columns of the record
  std::string fault;   // unit | sign | swap | lag | clip | freeze | lost | range | scenario
  double factor = 1;   // measured over what it should be [-]: unit, sign
  double seconds = 0;  // late (positive), lost, frozen or clipped time [s]
  std::string
      with;  // the other column, the scenario that fits; "phase", "conjugate", "decibels", "empty" ...
  std::string
      mend;  // a line to paste into the record's table of the case file; "": the data file is to be corrected
  double probability = 0;
};

/// One column of one record as the gate sees it.
struct GateColumn {
  std::string name;
  MatchedColumn column;    // over the noise floor, samples that are no numbers left out
  Match match;             // of it
  double floor = 1;        // of the channel [SI]
  bool explained = false;  // a fault was found: later checks leave it out
};

/// Faults of all records of the case. `predicted`: of the rig file as it is; floors are set.
/// `model` holds all rows. Records of `lost` have no prediction and are looked at by value only.
std::vector<DataFault> InspectData(const CaseModel& model, const std::vector<double>& predicted,
                                   const Hypothesis& h);

/// The same with each floor not above `stated` (per target): a gross error is no noise, whatever its
/// differences look like. The model's floors stay as they are.
std::vector<DataFault> InspectDataBelow(CaseModel& model, const std::vector<double>& predicted,
                                        const Hypothesis& h, const std::vector<double>& stated);

/// "record-3.h5: A.i3 looks like mA: channels.\"A.i3\" = ..."
std::string FaultText(const DataFault& fault);

// The checks, one per kind; each marks the columns that it explains. `record`: number in the case.
/// Columns that are empty or at one value in the whole record, and a bus of 0 V.
void CheckConstantColumns(const CaseModel& model, std::size_t record,
                          std::vector<GateColumn>& columns, std::vector<DataFault>& out);
/// Values far beyond what the rig can show, where they are few; later checks leave them out.
void CheckRange(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out);
/// Positions and coil currents that stand alone among their neighbours.
void CheckSpikes(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                 std::vector<DataFault>& out);
/// Stretches that stand still, are lost or end at a limit.
void CheckHeld(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
               std::vector<DataFault>& out);
/// Factors that mistakes make: units, signs.
void CheckUnits(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out);
/// Any factor of a coil current, or of the bus, with its level, after exchanges: a coil whose current were that far off
/// would move the other columns of its bearing, the bus those of all.
void CheckLevelFactors(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                       std::vector<DataFault>& out);
/// Columns exchanged: two, or more of one kind round a circle.
void CheckSwaps(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out);
/// Clocks that are late from some row on: of all columns, of those of one instrument or converter, of one or two columns.
void CheckTimes(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out);
/// A clock that only the measured speed shows: in a run-up that moves nothing else, or of the speed's column alone.
void CheckSpeedTime(const CaseModel& model, std::size_t record,
                    const std::vector<GateColumn>& columns, std::vector<DataFault>& out);
/// Unit or sign of the measured speed beside the profile of the scenario, or a stretch in which it stands still.
void CheckSpeed(const CaseModel& model, std::size_t record, std::vector<DataFault>& out);
/// Line of a case file that gives a column its right unit, or a gain where no unit does; `factor`:
/// measured over what it should be.
std::string UnitLine(const CaseRecord& r, const std::string& channel, double factor);
/// A record that lasts longer than its scenario: of another one, or of a logger that was stopped late.
void CheckLength(const CaseModel& model, std::size_t record, std::vector<DataFault>& out);
void CheckGaps(const CaseModel& model, std::size_t record, std::vector<DataFault>& out);
/// Against the predictions of the other records' scenarios.
void CheckScenario(const CaseModel& model, const Hypothesis& h, std::size_t record,
                   std::vector<GateColumn>& columns, std::vector<DataFault>& out);

}  // namespace ambrig
