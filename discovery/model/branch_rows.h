#pragma once
/// Rows in which the parameters of the rig decide between branches of the motion: the integrator of
/// a current loop that is held by its limiter for one period more changes a current by tens of
/// noise floors for milliseconds. The true machine takes one branch, a model a thousandth beside it
/// may take the other. No sensitivity tells such a jump, and an error there says little of the
/// laws.
#include <cstddef>
#include <string>
#include <vector>

namespace ambrig {

class CaseModel;
struct Hypothesis;

/// Rows of a model, which lie together.
struct RowRange {
  std::size_t first = 0, count = 0;
};

/// Samples `first` to `last` of one channel of a record's data, both included.
struct BranchSpan {
  std::size_t record = 0, channel = 0, first = 0, last = 0;
};

/// Where predictions along lines through the parameters' tolerances jump by more than six floors,
/// of clamped records over time. A channel that does so in more than three tenths of its rows is
/// left alone: it is no branch at instants. Empty without toleranced parameters. Floors are set.
std::vector<BranchSpan> FindBranches(const CaseModel& model, const Hypothesis& nominal);

/// Rows of `model`, which may be thinned otherwise than the one they were found with, that lie in
/// the spans.
std::vector<RowRange> RowsIn(const CaseModel& model, const std::vector<BranchSpan>& spans);

/// An error within the rows of a branch counts as two floors rms at most.
void LimitInBranches(const CaseModel& model, double* residual);

/// A change of a prediction [floors] within the rows of a branch that is a jump of more than six
/// floors rms becomes none: it tells no sensitivity.
void DropJumps(const CaseModel& model, double* change);

/// "record-6.toml: 540 rows of A.i2, A.i3: ..."; a line for each record with branches.
std::vector<std::string> BranchRemarks(const CaseModel& model,
                                       const std::vector<BranchSpan>& spans);

}  // namespace ambrig
