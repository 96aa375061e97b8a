#pragma once
/// Frequency responses of a hypothesis at the frequencies of a record: the exact linearisation
/// (linear_responses.h), and where the hypothesis has effects that it leaves out (hysteresis, a
/// soft bus, heating), times what they change in a simulated multisine test (multisine_response.h).
#include <list>
#include <map>
#include <mutex>

#include "discovery/model/multisine_response.h"
#include "discovery/model/record_predictor.h"

namespace ambrig {

/// Whether the linearised rig holds all that this effect does to a small signal. Found by building
/// the plant with it.
bool InLinearModel(const RigParameters& rig, const EffectInstance& effect);

class ResponsePredictor : public RecordPredictor {
 public:
  ResponsePredictor(const Case& c, const CaseRecord& record) : case_(c), record_(record) {}

  bool Predict(const RigParameters& rig, std::vector<std::vector<double>>& columns) const override;

  /// The responses themselves [SI], in the record's order; empty: the loop is unstable.
  using Responses = std::vector<std::vector<std::complex<double>>>;
  Responses Respond(const RigParameters& rig) const;

 private:
  struct Split {
    RigParameters linear;  // with the effects that the linear model holds
    bool all = true;       // there are no others
  };
  Split SplitOf(const RigParameters& rig) const;
  /// Multiplies by what the other effects change. false: the rotor is lost.
  bool Correct(const RigParameters& rig, const Split& split, Responses& out) const;
  std::vector<const MultisineMeasurement*> Tests() const;
  /// A test without the other effects: many hypotheses share it.
  std::optional<MultisineMeasurement::Spectra> BaseTest(const MultisineMeasurement& test,
                                                        std::size_t index,
                                                        const RigParameters& linear) const;

  const Case& case_;
  const CaseRecord& record_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, bool> in_linear_model_;               // by effect and target
  mutable std::vector<std::unique_ptr<MultisineMeasurement>> tests_;  // one per port
  struct Kept {
    std::string key;
    std::optional<MultisineMeasurement::Spectra> spectra;
  };
  mutable std::list<Kept> kept_;  // last used first
};

}  // namespace ambrig
