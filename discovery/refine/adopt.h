#pragma once
/// Writes a new rig file with an effect and its fitted parameters, and what the calibration found
/// of the toleranced ones (`fitted` beside `value`: the controller keeps the nominal values).
#include <memory>
#include <string>
#include <vector>

#include "discovery/decision/compare.h"
#include "discovery/explain/explain.h"

namespace ambrig {

/// TOML of the rig file `text` with `fitted` values put into its { value, sd } numbers; its effects
/// are replaced by `effects`. Comments and layout of the rest stay.
std::string AdoptedRigText(const std::string& text, const Hypothesis& h,
                           const std::vector<EffectInstance>& effects);

struct Adoption {
  Comparison before, after;
  FitResult fit;
  std::vector<EffectInstance> effects;  // all of the new rig, fitted; the adopted one last
  std::vector<LadderStep> ladder;
  std::vector<std::string> parameter_shifts;  // "bearings.A.gap +2.3 sd": beyond what is usual
  std::string rig_text;
  std::unique_ptr<Case> adopted_case;  // with the new rig
  std::unique_ptr<CaseModel> model;    // of it, floors set
};

/// Fits `effect` at `target` ("": where it explains most; "formula": those that the rig file holds)
/// beside everything that may move, and compares again. `output`: name of the new rig file in
/// errors.
/// @throws InputError
Adoption Adopt(const Case& c, const std::string& effect, const std::string& target,
               const std::string& output, const ExplainOptions& options);

}  // namespace ambrig
