#include "discovery/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/missing_force.h"
#include "discovery/residual_peaks.h"

namespace ambrig {

namespace {

struct Worst {
  const Target* target = nullptr;
  double ratio = 0;
};

Worst FindWorst(const CaseModel& model, const FitResult& fit, bool readings_only) {
  Worst worst;
  for (const Target& t : model.targets()) {
    const std::string& name = model.data().records[t.record].data.channels[t.channel].name;
    if (readings_only && !(name.ends_with(".x") || name.ends_with(".y") || name == "z")) continue;
    const double r = TargetRatio(model, fit.residual, t);
    if (r > worst.ratio) worst = {&t, r};
  }
  return worst;
}

std::string FrequencyText(const CaseModel& model, const std::vector<double>& frequencies, std::size_t record) {
  const CaseRecord& r = model.data().records[record];
  const double speed = r.scenario.speed.Speed(0.5 * r.scenario.duration) / (2 * kPi);
  std::string text;
  for (double f : frequencies) {
    text += fmt::format("{}{:.1f} Hz", text.empty() ? "" : ", ", f);
    if (speed > 1 && std::abs(f / speed - std::round(f / speed)) < 0.04) text += fmt::format(" (order {:.0f})", std::round(f / speed));
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
    (model.data().records[t.record].scenario.start == StartState::kClamped ? clamped : free_running) =
        std::max(TargetRatio(model, fit.residual, t),
                 model.data().records[t.record].scenario.start == StartState::kClamped ? clamped : free_running);
  u.block = clamped > 1.5 ? "coil or force" : "rotor or sensor";
  u.where = record.data.channels[any.target->channel].name;
  if (reading.target) {
    const CaseRecord& r = model.data().records[reading.target->record];
    const std::string channel = r.data.channels[reading.target->channel].name;
    const std::string plane = channel.substr(0, channel.find('.'));
    u.where = "plane " + plane + ", worst at " + channel;
    if (const auto force = DescribeMissingForce(model, fit.hypothesis, plane)) {
      u.dependence = fmt::format("{} ({:.0f} % of the missing force of {:.2g} N rms)", force->on, 100 * force->share, force->rms);
      u.formula = force->formula;
    }
  }
  u.text = fmt::format("{} in {}: {:.1f} times the noise at {}{}; the error stands out at {}; it depends most on {}.", u.block,
                       record.data_file, any.ratio, record.data.channels[any.target->channel].name, reading.target ? "; " + u.where : "", FrequencyText(model, u.frequencies, any.target->record),
                       u.dependence.empty() ? "nothing that was tried" : u.dependence);
  return u;
}

namespace {

struct Library {
  std::string name, toml;
};

/// Records that any such rig can make.
std::vector<Library> FeasibleScenarios(const RigParameters& rig) {
  std::string axis, coil;
  for (const auto& b : rig.bearings) {
    if (axis.empty()) axis = b.Axes()[0];
    if (coil.empty()) coil = b.name + ".coil1";
  }
  const std::string head = fmt::format("rig = \"rig.toml\"\nrecord_rate = {}\nnoise = false\n", rig.controller.rate);
  const std::string tail = fmt::format("[[excitation]]\ntarget = \"{}\"\nport = \"force\"\nkind = \"chirp\"\nf0 = 5.0\nf1 = 1200.0\nstart = 0.02\nstop = 0.3\namplitude = 5.0\n", axis);
  return {
      {"slow roll at 5 Hz", "name = \"slow\"\nduration = 0.4\n" + head + "[speed]\nprofile = [[0.0, 31.4]]\n"},
      {"run-up to 250 Hz", "name = \"run-up\"\nduration = 0.4\n" + head + "[speed]\nprofile = [[0.0, 0.0], [0.4, 1570.0]]\n"},
      {"force chirp 5 to 1200 Hz at standstill", "name = \"chirp\"\nduration = 0.3\n" + head + tail},
      {"force chirp at 150 Hz speed", "name = \"chirp\"\nduration = 0.3\n" + head + "[speed]\nprofile = [[0.0, 942.0]]\n" + tail},
      {"reference steps of 60 um", "name = \"steps\"\nduration = 0.3\n" + head + fmt::format("[[excitation]]\ntarget = \"{}\"\nport = \"reference\"\nkind = \"step\"\nstart = 0.05\nstop = 0.2\namplitude = 6e-5\n", axis)},
      {"clamped rotor, current ramp to 5 A in one coil", "name = \"ramp\"\nduration = 0.2\n" + head + fmt::format("[start]\nstate = \"clamped\"\n[[excitation]]\ntarget = \"{}\"\nport = \"current\"\nkind = \"ramp\"\nstart = 0.02\nstop = 0.18\namplitude = 5.0\n", coil)},
  };
}

}  // namespace

std::string SeparatingRecord(const CaseModel& model, const Hypothesis& first, const Hypothesis& second) {
  std::string best = "none of the scenarios tried tells them apart";
  double most = 2;
  for (const Library& item : FeasibleScenarios(model.data().rig)) {
    try {
      Case c;
      c.file = item.name;
      c.rig = model.data().rig;
      CaseRecord r;
      r.scenario = ReadScenarioText(item.toml, item.name, c.rig);
      r.data.rate = r.scenario.record_rate;
      const auto rows = static_cast<std::size_t>(r.scenario.duration * r.scenario.record_rate);
      for (const auto& b : c.rig.bearings) {
        for (const auto& axis : b.Axes()) r.data.channels.push_back({axis, "m", std::vector<double>(rows, 0)});
        for (int j = 1; j <= b.coils(); ++j) r.data.channels.push_back({fmt::format("{}.i{}", b.name, j), "A", std::vector<double>(rows, 0)});
      }
      for (const Channel& ch : r.data.channels) r.quality.push_back({ch.name, "good", true, std::vector<char>(rows, 1), 0, 0});
      c.records.push_back(std::move(r));
      CaseModel trial(c);
      const NoiseFloor floor = FindFloor(trial, first);
      const auto other = trial.Predict(second);
      if (!other) continue;
      double difference = 0;
      for (const Target& t : trial.targets()) {
        double sum = 0;
        for (std::size_t k = t.first; k < t.first + t.count; ++k) sum += std::pow((*other)[k] - floor.clean[k], 2);
        difference = std::max(difference, std::sqrt(sum / static_cast<double>(t.count)) / t.floor);
      }
      if (difference > most) {
        most = difference;
        best = fmt::format("{} (their outputs differ by {:.1f} times the noise)", item.name, difference);
      }
    } catch (const InputError&) {
      continue;  // this rig cannot run that scenario
    }
  }
  return best;
}

}  // namespace ambrig
