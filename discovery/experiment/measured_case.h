#pragma once
/// What the loggers of a true rig would have written, and how much an effect shows in it.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// Usual noise of what logs a rig, rms: of the bus [V], of a load cell [N], which goes with the
/// rotor's weight.
inline constexpr double kUsualBusNoise = 0.005;
double UsualLoadCellNoise(const RigParameters& rig);

/// The channel that a change moves most.
struct ShownChange {
  double ratio = 0;  // rms of the change over the noise floor
  std::string channel;
};
ShownChange WorstChannel(const CaseModel& model, const std::vector<double>& with,
                         const std::vector<double>& without);

struct ShownEffects {
  std::vector<EffectInstance> effects;
  ShownChange change;  // that they make
};
/// The effects of a size (1: as drawn) that the records show, neither hardly nor grotesquely: the
/// worst channel moves by 5 to 60 floors while the rotor is held. `truth`: the rig with what acts
/// besides, `without`: its prediction. Nothing when no size does.
std::optional<ShownEffects> VisibleEffects(
    const CaseModel& model, const Hypothesis& truth, const std::vector<double>& without,
    const std::function<std::vector<EffectInstance>(double)>& of_size);

/// Fills record `record` of `data` with what `truth` gives there, noise included.
/// `load_cell_noise` [N] rms.
void MeasureRecord(const CaseModel& model, const Hypothesis& truth, std::size_t record,
                   std::uint64_t seed, double load_cell_noise, Case& data);

}  // namespace ambrig
