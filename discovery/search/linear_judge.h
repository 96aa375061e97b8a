#pragma once
/// What one or several effects would explain of a residual if the model were linear in them: the
/// rig parameters' signatures are fitted beside theirs under the prior, bounds of the effects'
/// parameters kept, on the fit records; what is left there and on the unseen records is the score.
#include "discovery/search/local_share.h"
#include "discovery/search/signature_bank.h"

namespace ambrig {

struct Candidate {
  EffectInstance effect;                     // where a full fit should start
  double score = 0;                          // smaller is better, in units of 2 log likelihood
  double ratio_fit = 0, ratio_validate = 0;  // predicted by the linear step
  bool narrow = false;        // a resonance: the linear step says little, only a fit does
  std::size_t entry = 0;      // of the bank
  bool from_nominal = false;  // beside the rig file's own parameters, not those of the fit so far
  // of the same effect at the same target, worse at first sight
  std::vector<EffectInstance> other_starts;
};
constexpr std::size_t kOtherStarts = 1, kResonanceStarts = 15;

/// Two effects at once: what each starts from, and what they would leave together.
struct CandidatePair {
  EffectInstance first, second;
  double score = 0, ratio_fit = 0, ratio_validate = 0;
};

class LinearJudge {
 public:
  /// `base`: the fit so far with its sensitivities; `bank` may hold effects that `base` has
  /// already.
  LinearJudge(const CaseModel& model, const FitResult& base, SignatureBank& bank,
              double effective_sample_size);

  Candidate Single(const SignatureBank::Entry& entry) const;
  /// Share of the squared error above the noise that an entry's linear step takes off the readings
  /// and set-points of free rotors and off records that are not over time (0 to 1), of those that
  /// the bank looks at; 0 where these hold less than half of it, 1 where there is none.
  double MotionShare(const SignatureBank::Entry& entry) const;
  /// What an entry's linear step explains where the effect acts, of the records that the bank looks
  /// at.
  LocalShare ShareWhereItActs(const SignatureBank::Entry& entry) const;
  /// The amount of one signature that would be 3 sd of its own beside the rig parameters.
  double LeastVisible(const SignatureBank::Entry& entry, Eigen::Index column) const;
  /// rms of a signature over all rows, over the floor.
  double SignatureSize(const SignatureBank::Entry& entry, Eigen::Index column) const;
  CandidatePair Pair(const SignatureBank::Entry& first, const SignatureBank::Entry& second) const;

 private:
  struct Solution {
    Eigen::VectorXd amount;  // of each signature
    Eigen::VectorXd shift;   // of the base's free parameters
    double score = 0, ratio_fit = 0, ratio_validate = 0;
  };
  /// A signature's amount and the limits within which it is believed.
  struct Column {
    Eigen::Index at = 0;
    double lo = 0, hi = 0;
  };
  static std::vector<Column> ColumnsOf(const SignatureBank::Entry& entry);
  Solution Solve(const std::vector<Column>& columns, int parameters) const;
  /// The errors over the floor that an entry's linear step leaves, rows of the model.
  Eigen::VectorXd LeftBy(const SignatureBank::Entry& entry) const;
  Gram Assemble(const std::vector<Column>& columns) const;
  static EffectInstance Start(const SignatureBank::Entry& entry, const Eigen::VectorXd& amount,
                              Eigen::Index first);

  const CaseModel& model_;
  const FitResult& base_;
  double effective_sample_size_;
  Eigen::Index nb_;  // free parameters of the base
  const SignatureBank& signatures_;
  Gram own_, with_;  // [rig columns, residual] among themselves and with the bank
  const Gram& bank_;
  /// rms over the floor of fitted or unseen records: a sum of columns with these factors is left.
  double RatioLeft(const Gram& g, const Eigen::VectorXd& c, Which which) const;
  ErrorSums counted_[2];  // rows and points of the fitted and of the unseen records
  double worth_of_point_ = 1;
};

}  // namespace ambrig
