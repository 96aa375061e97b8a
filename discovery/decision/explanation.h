#pragma once
/// What explain answers: the verdict, the effects and the names that may be right, what remains,
/// and how the search came there.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "discovery/data_gate/data_gate.h"
#include "discovery/decision/decide.h"
#include "discovery/decision/evidence.h"
#include "discovery/search/visible_size.h"

namespace ambrig {

/// Two names of the ranking that the records leave open, and the record that would distinguish
/// them.
struct Confusable {
  std::string first, second, record;
};

/// One step of the ladder: what was believed and the error it left.
struct LadderStep {
  std::string added;  // "" for the rig file, "parameters", "eddy-currents at A"
  double ratio_fit = 0, ratio_validate = 0;  // [-] rms over the floor: fitted, validation records
};

/// What no effect explains.
struct Unexplained {
  std::string block, where, dependence, text, formula;
  std::vector<double> frequencies;  // [Hz] of the largest errors
};

struct Explanation {
  ExplanationVerdict verdict = ExplanationVerdict::kUnfinished;
  std::vector<RankedEffect> ranking;       // of the first round, best first
  std::vector<RankedEffect> second_round;  // of the last round that found anything or nothing
  std::vector<std::string>
      second_beside;  // effects beside which that round was ranked: "eddy-currents at A"
  std::vector<EffectInstance> adopted;  // established, whatever remains
  std::vector<SetMember> set;           // holds the right answer with 95 %
  // beside what the names of the ranking were judged again: "eddy-currents at A"; empty: alone
  std::vector<std::string> judged_beside;
  // of every further effect adopted, by its name: the same as ranking and set
  std::map<std::string, std::vector<RankedEffect>> beside;
  std::map<std::string, std::vector<SetMember>> further_sets;
  // what the law of the first effect adopted leaves in a free shape (`ambrig refine`), where that
  // was tried
  std::optional<StageRatios> shaped;
  Closure closure;
  Remainder remainder;
  std::vector<DataFault> data;
  NoiseModel noise;
  std::vector<NuisanceFound> nuisances;
  bool clocks_set_right = false;              // of some records, before the last search
  std::vector<VisibleSize> hidden;            // how large each effect could be without being seen
  std::vector<std::string> parameter_shifts;  // "bearings.A.gap +1.2 sd"
  // [-] rms over the floor, validation or fitted records: rig file, rig parameters fitted, all that
  // was adopted
  double nominal_ratio_validate = 0, base_ratio_validate = 0, final_ratio_validate = 0;
  double base_ratio_fit = 0, final_ratio_fit = 0;
  std::vector<Confusable> confusable;
  std::vector<LadderStep> ladder;
  Unexplained unexplained;
  std::vector<Candidate> screened;  // of the first round
  std::vector<std::string> warnings;
  Hypothesis base;  // the rig parameters fitted without what was found
  FitResult final_fit;
  double effective_sample_size = 0, seconds = 0;  // independent residuals [-], computing [s]
  long runs = 0;                                  // record simulations

  /// Whether the error is unknown for no other reason than that the rig parameters which explain it
  /// are not believed.
  bool ParametersNotBelieved() const {
    return verdict == ExplanationVerdict::kUnknown && remainder.kind == RemainderKind::kNone;
  }

  /// Whether `ambrig refine` of the first effect leaves what its free shape does: it fits without
  /// what was found to differ from record to record.
  bool RefineFollows() const {
    return shaped && adopted.size() == 1 &&
           std::all_of(nuisances.begin(), nuisances.end(),
                       [](const NuisanceFound& n) { return n.record.empty(); });
  }
};

}  // namespace ambrig
