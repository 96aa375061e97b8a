#pragma once
/// Clamped records that begin under a current which nothing states: their first rows tell what went
/// before.
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

struct UnstatedStart {
  std::size_t record = 0;
  std::string
      channel;  // the coil current that is farthest from what the scenario commands at first
  double measured = 0, predicted = 0;  // [A] in that row
  double settled = 0;                  // [s] of the record: from there on it is forgotten
};

/// Records with a coil current of whose first three rows one differs by more than 5 floors from
/// the prediction, while the rows behind five time constants of the coil (L/R) and its regulator
/// (kp/ki) do so less. None where the scenario states the current ([start] current). `model` holds
/// all rows, floors are set.
std::vector<UnstatedStart> UnstatedStartsOf(const CaseModel& model,
                                            const std::vector<double>& predicted);

/// The rows up to there, for CaseModel::LeaveOut.
std::vector<SampleSpan> SpansOf(const CaseModel& model, const std::vector<UnstatedStart>& starts);

/// One line for each.
std::vector<std::string> StartRemarks(const Case& c, const std::vector<UnstatedStart>& starts);

}  // namespace ambrig
