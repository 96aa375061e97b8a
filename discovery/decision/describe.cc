#include "discovery/decision/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "discovery/decision/missing_force.h"
#include "discovery/experiment/examination.h"
#include "discovery/search/residual_peaks.h"

namespace ambrig {

namespace {

constexpr double kWorthALaw = 0.3;  // of the unmodelled force, which a proposed law explains

struct Worst {
  const Target* target = nullptr;
  double ratio = 0;
};

Worst FindWorst(const CaseModel& model, const FitResult& fit, bool readings_only) {
  Worst worst;
  for (const Target& t : model.targets()) {
    const std::string& name = model.data().records[t.record].data.channels[t.channel].name;
    if (readings_only && !IsOfKind(name, ChannelKind::kReading)) continue;
    const double r = TargetRatio(model, fit.residual, t);
    if (r > worst.ratio) worst = {&t, r};
  }
  return worst;
}

std::string FrequencyText(const CaseModel& model, const std::vector<double>& frequencies,
                          std::size_t record) {
  const CaseRecord& r = model.data().records[record];
  const double speed = r.scenario.speed.Speed(0.5 * r.scenario.duration) / (2 * kPi);
  std::string text;
  for (double f : frequencies) {
    text += fmt::format("{}{:.1f} Hz", text.empty() ? "" : ", ", f);
    if (speed > 1 && std::abs(f / speed - std::round(f / speed)) < 0.04)
      text += fmt::format(" (order {:.0f})", std::round(f / speed));
  }
  return text;
}

}  // namespace

Unexplained Describe(const CaseModel& model, const FitResult& fit) {
  Unexplained u;
  const Worst any = FindWorst(model, fit, false), reading = FindWorst(model, fit, true);
  if (!any.target) return u;
  const CaseRecord& record = model.data().records[any.target->record];
  u.frequencies = FindPeaks(model, fit.residual).spectrum;
  double clamped = 0, free_running = 0;
  for (const Target& t : model.targets())
    (model.data().records[t.record].scenario.start == StartState::kClamped ? clamped
                                                                           : free_running) =
        std::max(TargetRatio(model, fit.residual, t),
                 model.data().records[t.record].scenario.start == StartState::kClamped
                     ? clamped
                     : free_running);
  u.block = clamped > 1.5 ? "coil or force" : "rotor or sensor";
  u.where = record.data.channels[any.target->channel].name;
  if (reading.target) {
    const CaseRecord& r = model.data().records[reading.target->record];
    const std::string channel = r.data.channels[reading.target->channel].name;
    const auto id = ParseChannel(channel);
    const std::string plane = id && !id->plane.empty() ? id->plane : channel;
    u.where = "plane " + plane + ", worst at " + channel;
    if (const auto force = DescribeMissingForce(model, fit.hypothesis, plane)) {
      u.dependence = fmt::format("{} ({:.0f} % of the unmodelled force of {:.2g} N rms)", force->on,
                                 100 * force->share, force->rms);
      if (force->share >= kWorthALaw) u.formula = force->formula;
    }
  }
  u.text = fmt::format(
      "{} in {}: {:.1f} times the noise at {}{}; the error is largest at {}; it depends most on "
      "{}.",
      u.block, record.data_file, any.ratio, record.data.channels[any.target->channel].name,
      reading.target ? "; " + u.where : "", FrequencyText(model, u.frequencies, any.target->record),
      u.dependence.empty() ? "nothing that was tried" : u.dependence);
  return u;
}

std::string SeparatingRecord(const CaseModel& model, const Hypothesis& first,
                             const Hypothesis& second) {
  std::string best = "none of the simulated scenarios discriminates between them";
  double most = 2;
  for (const ExaminationRecord& item : Examination(model.data().rig, 1)) {
    try {
      const Case c = EmptyCase(model.data().rig, {item});
      CaseModel trial(c);
      const NoiseFloor floor = FindFloor(trial, first);
      const auto other = trial.Predict(second);
      if (!other) continue;
      double difference = 0;
      for (const Target& t : trial.targets()) {
        double sum = 0;
        for (std::size_t k = t.first; k < t.first + t.count; ++k)
          sum += std::pow((*other)[k] - floor.clean[k], 2);
        difference = std::max(difference, std::sqrt(sum / static_cast<double>(t.count)) / t.floor);
      }
      if (difference > most) {
        most = difference;
        best = fmt::format("{} (their outputs differ by {:.1f} times the noise)", item.title,
                           difference);
      }
    } catch (const InputError&) {
      continue;  // this rig cannot run that scenario
    }
  }
  return best;
}

}  // namespace ambrig
