#pragma once
/// Rigs, plants and records with one effect, for the tests of effects/.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "scenarios/scenario.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

using Values = std::vector<std::pair<std::string, double>>;

inline RigParameters ReferenceRig() {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  rig.effects.clear();
  return rig;
}

inline RigParameters WithEffect(RigParameters rig, const std::string& id, const std::string& target,
                                const Values& values) {
  EffectInstance e = MakeInstance(*FindEffect(id), target);
  for (const auto& [name, value] : values) e.Set(name, value);
  rig.effects.push_back(e);
  return rig;
}

inline Plant PlantWith(const std::string& id, const std::string& target, const Values& values) {
  return BuildPlant(TrueRig(WithEffect(ReferenceRig(), id, target, values)));
}

/// All eight coils of bearing A at the same current.
inline Lane Currents(double i) {
  Lane lane;
  for (double& v : lane.v) v = i;
  return lane;
}

/// Flux of a pole at rest [Wb].
inline Lane RestFlux(Plant& plant, const Lane& currents, double x = 0) {
  plant.bearings[0].lanes.Settle(currents, x, 0);
  return plant.bearings[0].lanes.phi;
}

inline RunResult RunText(const RigParameters& rig, const std::string& text) {
  const Scenario scenario = ReadScenarioText(text, "test.toml", rig);
  return SwitchingEngine(rig, scenario, {}).Run();
}

/// A short levitated record under excitation, without noise: every channel that an effect can
/// reach.
inline const char* LevitatedText() {
  return R"(name = "levitated"
rig = "rig.toml"
duration = 0.02
record_rate = 25000.0
seed = 1
noise = false
[start]
state = "levitated"
[speed]
profile = [[0.0, 200.0], [0.02, 200.0]]
[[excitation]]
target = "A.x"
port = "force"
kind = "step"
start = 0.0
stop = 0.02
amplitude = 5.0
[[excitation]]
target = "B.y"
port = "reference"
kind = "step"
start = 0.005
stop = 0.02
amplitude = 5e-6
)";
}

/// Both bearings clamped at the centre, all coils of A stepping from 1 A to `high` at 10 ms.
inline std::string ClampedText(double high, double duration = 0.02) {
  std::string text =
      "name = \"clamped\"\nrig = \"rig.toml\"\nduration = " + std::to_string(duration) +
      "\nrecord_rate = 25000.0\nseed = 1\nnoise = false\n[start]\nstate = \"clamped\"\n"
      "position = { A = [0.0, 0.0], B = [0.0, 0.0] }\n[speed]\nprofile = [[0.0, 0.0], [1.0, "
      "0.0]]\n";
  for (int j = 1; j <= 8; ++j)
    for (const auto& [start, amplitude] : {std::pair{0.0, 1.0}, std::pair{0.01, high - 1}})
      text += "[[excitation]]\ntarget = \"A.coil" + std::to_string(j) +
              "\"\nport = \"current\"\nkind = \"step\"\nstart = " + std::to_string(start) +
              "\nstop = " + std::to_string(duration) +
              "\namplitude = " + std::to_string(amplitude) + "\n";
  return text;
}

/// Mean of a channel over its last rows.
inline double TailMean(const Record& record, const std::string& channel, std::size_t rows) {
  const auto& s = record.Find(channel)->samples;
  double sum = 0;
  for (std::size_t k = s.size() - rows; k < s.size(); ++k) sum += s[k];
  return sum / static_cast<double>(rows);
}

/// Largest change of any channel over that channel's own size.
inline double Change(const Record& a, const Record& b) {
  double worst = 0;
  for (const Channel& c : a.channels) {
    const Channel* d = b.Find(c.name);
    double size = 0, change = 0;
    for (std::size_t k = 0; k < c.samples.size(); ++k) {
      size = std::max(size, std::abs(c.samples[k]));
      change = std::max(change, std::abs(c.samples[k] - d->samples[k]));
    }
    // Positions come to rest near zero: judge them against a micrometre, currents against 10 mA.
    const bool position =
        c.name.find(".x") != std::string::npos || c.name.find(".y") != std::string::npos;
    worst = std::max(worst, change / std::max(size, position ? 1e-6 : 1e-2));
  }
  return worst;
}

}  // namespace ambrig
