#include "discovery/practice/hide.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "discovery/model/floor.h"
#include "discovery/model/residual.h"
#include "effects/catalogue.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

// of the worst channel: to be seen, and not grotesque
constexpr double kLeastRatio = 5, kMostRatio = 60;
constexpr double kHiddenLoadCellNoise = 0.0012;  // of the rotor's weight, rms

/// Streams of random numbers of one seed.
enum HideStream : std::uint32_t { kParameters = 101, kTargets, kSizeStream, kLoadCells };

RigParameters DrawRig(const RigParameters& rig, const HideRequest& request) {
  RigParameters truth = rig;
  if (!request.draw_parameters) return truth;
  std::uint64_t k = 0;
  for (const Tolerance& t : rig.tolerances)
    if (const double* at = ParameterAt(rig, t.path))
      SetParameter(truth, t.path,
                   *at + t.sd * std::clamp(Normal(request.seed, kParameters, k++), -2.5, 2.5));
  return truth;
}

EffectInstance DrawEffect(const EffectDescription& d, const std::string& target, std::uint64_t seed,
                          std::uint32_t slot) {
  EffectInstance e = MakeInstance(d, target);
  for (std::size_t k = 0; k < d.parameters.size(); ++k) {
    const EffectParameter& p = d.parameters[k];
    const auto index = slot * 64 + 2 * static_cast<std::uint32_t>(k);
    const double size = p.typical_lo > 0
                            ? p.typical_lo * std::pow(p.typical_hi / p.typical_lo,
                                                      Uniform(seed, kSizeStream, index))
                            : p.null_value;
    const double sign = Uniform(seed, kSizeStream, index + 1) < 0.5 ? -1 : 1;
    if (d.mains && p.name == "frequency") e.values[k] = sign > 0 ? 50 : 60;
    // an optional extra stays out
    else if (!d.Switches(p))
      e.values[k] = p.null_value == 0 ? 0 : size;
    else if (std::isinf(p.null_value))
      e.values[k] = size;
    else
      e.values[k] = std::clamp(p.null_value + (p.null_value + sign * size < p.lo ? 1 : sign) * size,
                               p.lo, p.hi);
  }
  return e;
}

/// The effect with its switches `k` times as far from their nulls, at most twice what is usual.
EffectInstance ScaledEffect(const EffectDescription& d, const EffectInstance& e, double k) {
  EffectInstance out = e;
  for (std::size_t row = 0; row < d.parameters.size(); ++row) {
    const EffectParameter& p = d.parameters[row];
    if (!d.Switches(p)) continue;
    if (std::isinf(p.null_value)) {
      out.values[row] = std::clamp(std::max(e.values[row] / k, 0.5 * p.typical_lo), p.lo, p.hi);
      continue;
    }
    const double distance =
        std::clamp(k * (e.values[row] - p.null_value), -2 * p.typical_hi, 2 * p.typical_hi);
    out.values[row] = std::clamp(p.null_value + distance, p.lo, p.hi);
  }
  return out;
}

struct Shown {
  double ratio = 0;
  std::string channel;
};

Shown WorstChannel(const CaseModel& model, const std::vector<double>& with,
                   const std::vector<double>& without) {
  Shown worst;
  for (const Target& t : model.targets()) {
    double sum = 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      sum += std::pow(with[k] - without[k], 2);
    const double ratio =
        std::sqrt(sum / static_cast<double>(std::max<std::size_t>(t.count, 1))) / t.floor;
    const CaseRecord& r = model.data().records[t.record];
    if (ratio > worst.ratio) worst = {ratio, r.data.channels[t.channel].name};
  }
  return worst;
}

std::string DrawTarget(const EffectDescription& d, const RigParameters& rig,
                       const std::string& wanted, std::uint64_t seed, std::uint32_t slot) {
  const std::vector<std::string> possible = TargetsOf(d, TargetsOfEffects(rig));
  std::string names;
  for (const std::string& t : possible) {
    if (t == wanted) return t;
    names += (names.empty() ? "" : ", ") + t;
  }
  if (possible.empty())
    throw InputError(fmt::format("{}: this rig has no target for this effect", d.id));
  if (!wanted.empty())
    throw InputError(fmt::format("{}@{}: no such target, allowed: {}", d.id, wanted, names));
  return possible[static_cast<std::size_t>(Uniform(seed, kTargets, slot) *
                                           static_cast<double>(possible.size()))];
}

/// The effect drawn and brought to a size that these records show with the rotor held.
EffectInstance VisibleEffect(const CaseModel& model, const Hypothesis& truth,
                             const std::vector<double>& without, const EffectDescription& d,
                             const EffectInstance& drawn, Shown* shown) {
  double k = 1;
  for (int attempt = 0; attempt < 12; ++attempt) {
    Hypothesis h = truth;
    h.rig.effects.push_back(ScaledEffect(d, drawn, k));
    const auto with = model.Predict(h);
    *shown = with ? WorstChannel(model, *with, without) : Shown{kInfinity, ""};
    if (shown->ratio >= kLeastRatio && shown->ratio <= kMostRatio) return h.rig.effects.back();
    k *= !with ? 0.5 : shown->ratio < kLeastRatio ? 2.0 : 0.7;
  }
  throw InputError(fmt::format(
      "{}@{}: no size of this effect is visible in these records without losing levitation", d.id,
      drawn.target));
}

/// What the loggers of the true rig would have written.
void Measure(const CaseModel& model, const Hypothesis& truth, std::uint64_t seed,
             double load_cell_noise, Case& data) {
  for (std::size_t r = 0; r < data.records.size(); ++r) {
    const Record simulated = model.Simulated(truth, r, true, seed * 1000003 + r);
    std::uint64_t cell = 0;
    for (Channel& ch : data.records[r].data.channels) {
      const Channel* from = simulated.Find(ch.name);
      if (!from)
        throw InputError(fmt::format("\"{}\": the simulation gives no channel {}",
                                     data.records[r].scenario.name, ch.name));
      ch.samples.assign(from->samples.begin(),
                        from->samples.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                    from->samples.size(), ch.samples.size())));
      if (!IsOfKind(ch.name, ChannelKind::kLoadCell)) continue;
      for (std::size_t k = 0; k < ch.samples.size(); ++k)
        ch.samples[k] += load_cell_noise *
                         Normal(seed, kLoadCells + static_cast<std::uint32_t>(r), (cell << 32) + k);
      ++cell;
    }
  }
}

}  // namespace

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
  const double load_cell_noise = kHiddenLoadCellNoise * rig.rotor.mass * 9.81;
  out.data.noise[ChannelId{ChannelKind::kBus}.name()] = 0.005;
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->two_axes)
      for (const ChannelId& cell : ChannelsOf(b, ChannelKind::kLoadCell))
        out.data.noise[cell.name()] = load_cell_noise;
  CaseModel model(out.data);
  model.stop = stop;
  Hypothesis truth;
  truth.rig = DrawRig(rig, request);
  const NoiseFloor floor = FindFloor(model, truth);
  for (std::size_t k = 0; k < descriptions.size(); ++k) {
    const EffectDescription& d = *descriptions[k];
    const auto slot = static_cast<std::uint32_t>(k);
    const EffectInstance drawn = DrawEffect(
        d, DrawTarget(d, rig, request.effects[k].second, request.seed, slot), request.seed, slot);
    Shown shown;
    out.effects.push_back(VisibleEffect(model, truth, floor.clean, d, drawn, &shown));
    if (shown.ratio > out.worst_ratio) {
      out.worst_ratio = shown.ratio;
      out.worst_channel = shown.channel;
    }
  }
  for (const EffectInstance& e : out.effects) truth.rig.effects.push_back(e);
  out.truth = truth.rig;
  truth.rig = WithNoise(truth.rig, StatedNoise(truth.rig, out.data.noise));
  Measure(model, truth, request.seed, load_cell_noise, out.data);
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
  std::string effects, parameters, truth;
  for (const EffectInstance& e : hidden.effects) {
    effects += fmt::format("    [{{ effect = \"{}\", target = \"{}\" }}],\n", e.name, e.target);
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
      "times the noise at {}\"\nseed = {}\ntrue_parameters = {{ {} }}\n",
      name, verdict, effects, parameters, hidden.worst_ratio,
      hidden.worst_channel.empty() ? "-" : hidden.worst_channel, request.seed, truth);
}

}  // namespace ambrig
