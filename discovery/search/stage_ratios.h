#pragma once
/// How large the errors of a stage of a search are, and what a further stage explains of them.

namespace ambrig {

/// Share of the error above the floor that a better model removes on unseen records, 0 to 1.
double ExplainedShare(double ratio_before, double ratio_after);

/// Errors over the noise of one stage of the search: fitted records, unseen ones, the worst record,
/// the worst channel of a record.
struct StageRatios {
  double fit = 0, validate = 0, worst_record = 0, worst_channel = 0;
  /// The largest that a verdict has to answer for.
  double Answered() const;
};

/// Share of the squared error above the noise that was explained, of fitted and unseen records
/// together. Unseen records that hardly show an effect count little, but they must not contradict:
/// the share is at most half above theirs.
double ShareOfAllRecords(const StageRatios& before, const StageRatios& after);

}  // namespace ambrig
