#pragma once
/// Errors of the data as hypotheses, tried before any fit: a wrong unit, sign, column, clock or
/// scenario changes what a logger wrote and nothing else, so that undoing it brings the column back
/// to the model's prediction. What the rig itself does differently changes other columns too and
/// is left to the fits. Only gross errors are named; method: docs/theory/data_gate.md.
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// What is wrong with a whole column (DataFault::with).
inline constexpr const char *kEmpty = "empty", *kWholeColumn = "whole record";

/// A record of another machine, or of this one in another state (DataFault::with).
inline constexpr const char* kOtherMachine = "another machine";

/// Floors above which an error of a column is gross; below it a fit may speak first.
inline constexpr double kGrossError = 10;

struct DataFault {
  std::string record, channel;  // data file; "" for all columns of the record
  std::string fault;   // unit | sign | swap | lag | clip | freeze | lost | range | scenario |
                       // controller (record: the rig file, channel: a bearing, or "the rig")
  double factor = 1;   // measured over what it should be [-]: unit, sign
  double seconds = 0;  // late (positive), lost, frozen or clipped time [s]
  // the other column, the scenario that fits; "phase", "conjugate", "decibels", "empty" ...
  std::string with;
  // a line to paste into the record's table of the case file; "": the data file is to be corrected
  std::string mend;
  std::string detail;  // what shows it, where no column's prediction does
  double probability = 0;
};

/// Faults of all records of the case. `predicted`: of the rig file as it is; floors are set.
/// `model` holds all rows. Records of `lost` have no prediction and are looked at by value only.
std::vector<DataFault> InspectData(const CaseModel& model, const std::vector<double>& predicted,
                                   const Hypothesis& h);

/// Faults `scenario` of exchanged records, of speeds that were not logged, and of loads and
/// commands that acted otherwise than stated, which show where the other records agree: beside
/// parameters that were fitted, too, as `predicted` and `h` then are.
std::vector<DataFault> InspectInputs(const CaseModel& model, const std::vector<double>& predicted,
                                     const Hypothesis& h);

/// InspectData with each floor not above `stated` (per target): a gross error is no noise, whatever
/// its differences look like. The model's floors stay as they are.
std::vector<DataFault> InspectDataBelow(CaseModel& model, const std::vector<double>& predicted,
                                        const Hypothesis& h, const std::vector<double>& stated);

/// "record-3.h5: A.i3 looks like mA: channels.\"A.i3\" = ..."
std::string FaultText(const DataFault& fault);

}  // namespace ambrig
