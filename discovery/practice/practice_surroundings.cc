#include "discovery/practice/practice_surroundings.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/toml_edit.h"
#include "core/math/noise.h"
#include "core/record/channels.h"
#include "discovery/experiment/measured_case.h"
#include "discovery/practice/laws/practice_law.h"
#include "effects/catalogue.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_channels.h"

namespace ambrig {

namespace {

/// Streams of random numbers of one case.
enum SurroundingStream : std::uint32_t {
  kNuisanceSizeStream = 241,
  kNoiseStream,
  kPerRecordStream,
  kZeroStream
};

constexpr double kZeroOfReach = 0.01;    // sd of a position sensor's zero, of the clearance
constexpr double kInputSpread = 0.01;    // sd of the commanded signals' size
constexpr double kClockSpread = 1e-4;    // [s] sd stated of the time shift; drawn: whole rows
constexpr double kShiftedRecords = 0.3;  // share of the records whose clock is one row off

/// Rows later (> 0) or earlier; the row at the edge is repeated.
void ShiftRows(Record& data, int rows) {
  for (Channel& ch : data.channels) {
    std::vector<double>& y = ch.samples;
    if (y.size() < 3 || rows == 0) continue;
    if (rows > 0) {
      y.insert(y.begin(), y.front());
      y.pop_back();
    } else {
      y.erase(y.begin());
      y.push_back(y.back());
    }
  }
}

std::string Table(const std::map<std::string, double>& numbers) {
  std::string text;
  for (const auto& [name, value] : numbers)
    text += fmt::format("{}\"{}\" = {:.4g}", text.empty() ? "" : ", ", name, value);
  return text;
}

std::string Quoted(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& t : texts) out += (out.empty() ? "\"" : ", \"") + t + "\"";
  return out;
}

}  // namespace

std::string WithOtherSizes(const std::string& text, const std::string& file, std::uint64_t seed) {
  PracticeDraw draw(seed, kNuisanceSizeStream);
  const double heavier = draw.Log(0.75, 1.35), longer = draw.Log(0.85, 1.2),
               wider = draw.Log(0.9, 1.15);
  const std::pair<const char*, double> factors[] = {
      {"rotor.mass", heavier},
      {"rotor.inertia_transverse", heavier * longer * longer},
      {"rotor.inertia_polar", heavier},
      {"controller.kp", heavier},
      {"controller.kd", heavier},
      {"controller.ki", heavier},
      {"controller.f_max", heavier},
      {"bearings.A.pole_area", heavier * wider},
      {"bearings.A.gap", wider},
      {"bearings.A.leakage_inductance", draw.Log(0.85, 1.2)},
      {"bearings.A.resistance", draw.Log(0.8, 1.25)}};
  std::vector<TomlEdit> edits;
  for (const auto& [path, factor] : factors)
    if (HasTomlPath(text, file, path))
      edits.push_back(
          {path, std::stod(fmt::format("{:.4g}", TomlNumberAt(text, file, path) * factor))});
  return EditedToml(text, file, edits);
}

Surroundings DrawSurroundings(const RigParameters& rig, std::uint64_t seed) {
  PracticeDraw draw(seed, kNoiseStream);
  Surroundings s;
  const char* const modes[] = {"stated", "not stated", "wrongly stated"};
  s.noise_mode = modes[draw.Of(3)];
  s.cell_noise = UsualLoadCellNoise(rig) * draw.Log(0.5, 3);
  s.noise[ChannelId{ChannelKind::kBus}.name()] = kUsualBusNoise * draw.Log(0.5, 4);
  const double reading = s.noise_mode == "not stated" ? 1 : draw.Log(0.5, 3);
  if (s.noise_mode == "wrongly stated") s.current_factor = draw.Log(0.4, 2.5);
  for (const BearingParameters& b : rig.bearings) {
    for (const ChannelId& id : ChannelsOf(b, ChannelKind::kReading))
      s.noise[id.name()] = b.sensor.noise * reading;
    if (b.kind->two_axes)
      for (const ChannelId& id : ChannelsOf(b, ChannelKind::kLoadCell))
        s.noise[id.name()] = s.cell_noise;
  }
  if (s.noise_mode == "stated") s.stated = s.noise;
  if (s.noise_mode == "wrongly stated")
    for (const ChannelKind kind :
         {ChannelKind::kBus, ChannelKind::kReading, ChannelKind::kLoadCell}) {
      const double wrong = draw.Sign() < 0 ? draw.Log(0.05, 0.5) : draw.Log(2, 20);
      for (const auto& [name, rms] : s.noise)
        if (IsOfKind(name, kind)) s.stated[name] = rms * wrong;
    }
  const std::size_t nuisances = draw.Of(5);
  s.nuisance_mode = nuisances == 0 ? "declared" : nuisances == 1 ? "not declared" : "none";
  if (nuisances < 2) {
    for (const BearingParameters& b : rig.bearings)
      if (b.kind->two_axes)
        for (const std::string& axis : b.Axes()) s.zero[axis] = kZeroOfReach * ClearanceOf(b);
    s.input_gain = kInputSpread;
    s.time_shift = kClockSpread;
  }
  return s;
}

void SetTrueNoise(const Surroundings& s, RigParameters& truth, Case& data) {
  truth.amplifier.current_noise *= s.current_factor;
  data.noise = s.noise;
  truth = WithNoise(truth, StatedNoise(truth, s.noise));
}

void FillRecords(const Surroundings& s, const Hypothesis& truth, std::uint64_t seed,
                 const std::atomic<bool>* stop, Case& data) {
  Case commanded = data;  // what the amplifiers made of the commands
  PracticeDraw draw(seed, kPerRecordStream);
  std::uint64_t index = 0;
  const auto normal = [&] { return Normal(seed, kZeroStream, index++); };
  std::vector<Hypothesis> truths;
  std::vector<int> shift;
  for (CaseRecord& r : commanded.records) {
    const double gain = 1 + s.input_gain * normal();
    for (Excitation& e : r.scenario.excitations)
      if (s.input_gain > 0) e.amplitude *= gain;
    truths.push_back(truth);
    for (const auto& [axis, sd] : s.zero)
      truths.back().rig.effects.push_back(
          CatalogueEffect("sensor-offset", axis, {{"offset", sd * normal()}}));
    const bool late = draw.Between(0, 1) < kShiftedRecords;
    const double sign = draw.Sign();
    shift.push_back(s.time_shift > 0 && late ? static_cast<int>(sign) : 0);
  }
  CaseModel model(commanded);
  model.stop = stop;
  for (std::size_t r = 0; r < data.records.size(); ++r) {
    MeasureRecord(model, truths[r], r, seed, s.cell_noise, data);
    ShiftRows(data.records[r].data, shift[r]);
  }
}

std::vector<NamedEffect> RightNames(const std::string& effect, const std::string& target) {
  std::vector<NamedEffect> names{{effect, target}};
  // On a rigid rotor a bow is a pair of unbalances to the eye of the records.
  if (effect == "shaft-bow") names.insert(names.end(), {{"unbalance", "A"}, {"unbalance", "B"}});
  return names;
}

std::string PracticeCaseText(const Surroundings& s, const std::vector<ExaminationRecord>& records) {
  std::string text = "# made by ambrig practice\nrig = \"rig.toml\"\n";
  if (!s.stated.empty()) text += fmt::format("noise = {{ {} }}\n", Table(s.stated));
  if (s.nuisance_mode == "declared")
    text += fmt::format("\n[nuisance]\nsensor_zero = {{ {} }}\ntime_shift = {}\ninput_gain = {}\n",
                        Table(s.zero), s.time_shift, s.input_gain);
  for (std::size_t r = 0; r < records.size(); ++r)
    text += fmt::format(
        "\n[[record]]  # {}\nscenario = \"record-{}.toml\"\ndata = \"record-{}.h5\"\nuse = "
        "\"{}\"\n",
        records[r].title, r + 1, r + 1, records[r].validate ? "validate" : "fit");
  return text;
}

std::string PracticeAnswerText(const PracticeCase& c, std::uint64_t seed) {
  return fmt::format(
      "[\"{}\"]\nverdict = [{}]\neffects = [\n{}]\nkind = \"{}\"\nlaws = [{}]\nfamilies = "
      "[{}]\nrig = \"{}\"\nnoise = \"{}\"\nnuisances = \"{}\"\nmistake = \"{}\"\nuse = "
      "\"{}\"\nworst = {:.3g}\nseed = {}\n",
      c.name, Quoted(c.answer.verdicts), SlotsText(c.answer.slots), c.kind, Quoted(c.laws),
      Quoted(c.families), c.rig, c.noise, c.nuisances, c.mistake, c.for_fit ? "fit" : "check",
      c.worst_ratio, seed);
}

}  // namespace ambrig
