#pragma once
/// Cases with a known answer, to practise and to cross-validate: a rig whose parameters are sampled
/// within their sd and whose effects are sampled within their usual size, examined with noise.
#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "discovery/experiment/examination.h"

namespace ambrig {

struct HideRequest {
  std::vector<std::pair<std::string, std::string>> effects;  // id, target; "" draws one
  bool draw_parameters = true;
  std::uint64_t seed = 1;
};

struct HiddenCase {
  Case data;  // records filled with what the true rig gave
  std::vector<ExaminationRecord> records;
  std::vector<EffectInstance> effects;  // as they are in the true rig
  RigParameters truth;
  // error over the noise that the effects make, worst channel
  double worst_ratio = 0;
  std::string worst_channel;
};

/// @throws InputError for unknown names, and where no size of the effect shows in these records
/// with the rotor held; Interrupted when `stop` is set.
HiddenCase Hide(const RigParameters& rig, const HideRequest& request,
                const std::atomic<bool>* stop = nullptr);

/// case.toml, and the answer in the form of docs/guide/files.md (answers) under `name`.
std::string CaseText(const HiddenCase& hidden);
std::string AnswerText(const HiddenCase& hidden, const HideRequest& request,
                       const std::string& name);

}  // namespace ambrig
