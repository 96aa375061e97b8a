#pragma once
/// The names that rounds and comparisons of a search have ranked. Owns the rankings as they are
/// reported, what the first round screened, and of every round what tells later which names were
/// open in it.
#include <map>
#include <string>
#include <vector>

#include "discovery/decision/explanation.h"
#include "discovery/explain/adopted_effects.h"
#include "discovery/explain/search_models.h"

namespace ambrig {

class NameRankings {
 public:
  const std::vector<RankedEffect>& first() const { return first_; }
  const std::vector<Candidate>& screened() const { return screened_; }

  /// What the screening of the first round promises.
  void NoteScreened(std::vector<Candidate> screened) { screened_ = std::move(screened); }
  /// The ranking of round number `round`, best first: of the first one, or of the last one.
  void NoteRound(int round, const std::vector<RankedEffect>& ranking);
  /// The ranking beside the free shape of another effect's law, in which `found` was adopted.
  void NoteRoundBesideShape(const EffectInstance& found, const std::vector<RankedEffect>& ranking);
  /// Adopted effect number `index` compared with its rivals beside the others. The ranking of the
  /// first effect becomes the one reported; what was not compared there follows it.
  void NoteComparison(const AdoptedEffects& adopted, std::size_t index,
                      std::vector<RankedEffect> ranking);
  /// The names of the first ranking were compared again beside these.
  void NoteJudgedBeside(const AdoptedEffects& adopted);
  void ForgetJudgedBeside() { judged_beside_.clear(); }
  /// The comparison of a further effect that is given up.
  void ForgetComparison(const EffectInstance& e) { beside_.erase(Named(e)); }

  /// Members of the round in which the effect was most probable that are still open (of the first
  /// effect, where no round ranked it, those of the first round), and of the other rounds those
  /// that came within a twentieth of the best fit: what went into the second place nearly as well
  /// as its owner may belong into the first one beside it. An effect that was adopted for its own
  /// channels has rivals at its own place only.
  std::vector<EffectInstance> RivalsOf(const AdoptedEffects& adopted, std::size_t index) const;
  /// Whether a round compared both names with the shapes of their laws free: no law of the
  /// catalogue tells more than these.
  bool ComparedByShape(const EffectInstance& a, const EffectInstance& b) const;
  /// Names that share a free magnetisation curve keep their odds in a ranking of their laws beside
  /// other effects: no law of the catalogue is that curve. Scores only; whether any changed.
  bool KeepSharedCurve(std::vector<RankedEffect>& ranking) const;
  /// Whether a comparison of this further effect leaves its name less than this probability.
  bool IsDoubtful(const EffectInstance& e, double least) const;

  /// What rounds that are taken back have changed.
  struct State {
    std::size_t rounds = 0;
    std::vector<RankedEffect> last_round;
  };
  State Now() const { return {rounds_.size(), last_round_}; }
  void BackTo(State before);

  /// An adopted effect has one size, that of the last fit. The sd of others is stated under the
  /// same doubt.
  void StateSizes(const SearchModels& models, const AdoptedEffects& adopted);
  /// The rankings as they are now, without sensitivities.
  void CopyTo(Explanation& out) const;
  /// The rankings, which end here.
  void MoveTo(Explanation& out);

 private:
  /// A name of a round, as it was fitted there.
  struct RankedName {
    EffectInstance effect;
    double probability = 0, ratio = 0;  // ratio_fit of its fit
    bool by_shape = false;              // with the shape of its law free
    bool shares_curve = false;
  };
  void KeepNames(const std::vector<RankedEffect>& ranking);

  std::vector<std::vector<RankedName>> rounds_;  // of each round that ranked any
  std::vector<Candidate> screened_;
  std::vector<RankedEffect> first_, last_round_;
  std::map<std::string, std::vector<RankedEffect>> beside_;  // by the name of the further effect
  std::vector<std::string> judged_beside_;
};

}  // namespace ambrig
