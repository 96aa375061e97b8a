#include "discovery/practice/hide.h"

#include <fmt/format.h>

#include "core/record/channels.h"
#include "discovery/experiment/measured_case.h"
#include "discovery/model/floor.h"
#include "discovery/practice/case_score.h"
#include "discovery/practice/drawn_truth.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rig/rig_channels.h"

namespace ambrig {

HiddenCase Hide(const RigParameters& rig, const HideRequest& request,
                const std::atomic<bool>* stop) {
  HiddenCase out;
  ExaminationNeeds needs;
  std::vector<const EffectDescription*> descriptions;
  for (const auto& [id, target] : request.effects) {
    const EffectDescription* d = &EffectNamed(id);
    if (d->users_own)
      throw InputError(
          id +
          ": a law of the rig file's own cannot be drawn at random, allowed: an effect that "
          "`ambrig explain` proposes");
    needs.contact = needs.contact || d->needs.contact;
    needs.free_speed = needs.free_speed || d->needs.free_speed;
    descriptions.push_back(d);
  }
  out.records = Examination(rig, request.seed, needs);
  out.data = EmptyCase(rig, out.records);
  const double load_cell_noise = UsualLoadCellNoise(rig);
  out.data.noise[ChannelId{ChannelKind::kBus}.name()] = 0.005;
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->two_axes)
      for (const ChannelId& cell : ChannelsOf(b, ChannelKind::kLoadCell))
        out.data.noise[cell.name()] = load_cell_noise;
  CaseModel model(out.data);
  model.stop = stop;
  Hypothesis truth;
  truth.rig = request.draw_parameters ? DrawRig(rig, request.seed) : rig;
  const NoiseFloor floor = FindFloor(model, truth);
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    const EffectDescription& d = *descriptions[k];
    const auto slot = static_cast<std::uint32_t>(k);
    const EffectInstance drawn = DrawEffect(
        d, DrawTarget(d, rig, request.effects[k].second, request.seed, slot), request.seed, slot);
    const auto visible = VisibleEffects(model, truth, floor.clean, [&](double size) {
      return std::vector{ScaledEffect(d, drawn, size)};
    });
    if (!visible)
      throw InputError(fmt::format(
          "{}@{}: no size of this effect is visible in these records without losing levitation",
          d.id, drawn.target));
    out.effects.push_back(visible->effects[0]);
    if (visible->change.ratio > out.worst_ratio) {
      out.worst_ratio = visible->change.ratio;
      out.worst_channel = visible->change.channel;
    }
  }
  for (const EffectInstance& e : out.effects) truth.rig.effects.push_back(e);
  out.truth = truth.rig;
  truth.rig = WithNoise(truth.rig, StatedNoise(truth.rig, out.data.noise));
  for (std::size_t r = 0; r < out.data.records.size(); ++r)
    MeasureRecord(model, truth, r, request.seed, load_cell_noise, out.data);
  return out;
}

std::string CaseText(const HiddenCase& hidden) {
  std::string noise, text;
  for (const auto& [channel, rms] : hidden.data.noise)
    noise += fmt::format("{}\"{}\" = {:.4g}", noise.empty() ? "" : ", ", channel, rms);
  text = fmt::format("rig = \"rig.toml\"\nnoise = {{ {} }}\n", noise);
  for (std::size_t r = 0; r < hidden.records.size(); ++r)
    text += fmt::format(
        "\n[[record]]  # {}\nscenario = \"record-{}.toml\"\ndata = \"record-{}.h5\"\nuse = "
        "\"{}\"\n",
        hidden.records[r].title, r + 1, r + 1, hidden.records[r].validate ? "validate" : "fit");
  return text;
}

std::string AnswerText(const HiddenCase& hidden, const HideRequest& request,
                       const std::string& name) {
  std::vector<std::vector<NamedEffect>> slots;
  std::string parameters, truth;
  for (const EffectInstance& e : hidden.effects) {
    slots.push_back({{e.name, e.target}});
    for (std::size_t k = 0; k < e.table.size(); ++k)
      parameters += fmt::format("{}\"{}.{}\" = {:.9g}", parameters.empty() ? "" : ", ", e.name,
                                e.table[k].name, e.values[k]);
  }
  for (const Tolerance& t : hidden.truth.tolerances)
    truth += fmt::format("{}\"{}\" = {:.9g}", truth.empty() ? "" : ", ", t.path,
                         *ParameterAt(hidden.truth, t.path));
  const char* verdict = !hidden.effects.empty()   ? "effect"
                        : request.draw_parameters ? "parameters"
                                                  : "none";
  return fmt::format(
      "[\"{}\"]\nverdict = [\"{}\"]\neffects = [\n{}]\nparameters = {{ {} }}\nworst = \"{:.1f} "
      "times the noise at {}\"\nseed = {}\nunit = {:.0f}\ntrue_parameters = {{ {} }}\n",
      name, verdict, SlotsText(slots), parameters, hidden.worst_ratio,
      hidden.worst_channel.empty() ? "-" : hidden.worst_channel, request.seed,
      hidden.truth.amplifier.unit, truth);
}

}  // namespace ambrig
