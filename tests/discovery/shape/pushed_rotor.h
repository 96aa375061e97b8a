#pragma once
/// A rotor that runs up while bearing A pushes it: its readings there tell forces of the motion and
/// sensors from each other.
#include <memory>
#include <string>

#include "core/math/noise.h"
#include "discovery/experiment/examination.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {

inline constexpr double kReadingNoise = 1e-7, kMotionN = 2000;  // [m], independent numbers

/// The rotor, running up, pushed at bearing A by three tones in each axis; its readings there
/// count.
inline Case PushedCase() {
  RigParameters rig = ReferenceRig();
  rig.tolerances.clear();
  std::string text =
      "name = \"pushed\"\nrig = \"rig.toml\"\nduration = 0.3\nrecord_rate = 12500.0\nseed = 1\n"
      "noise = false\nfault_tolerance = false\n[start]\nstate = \"levitated\"\n[speed]\n"
      "profile = [[0.0, 150.0], [0.3, 300.0]]\n";
  for (const char* axis : {"x", "y"})
    text += std::string("[[excitation]]\ntarget = \"A.") + axis +
            "\"\nport = \"force\"\nkind = \"multisine\"\nstart = 0.02\nstop = 0.3\nfrequencies = " +
            (*axis == 'x' ? "[30.0, 55.0, 110.0]\nphases = [0.3, 1.9, 4.0]"
                          : "[37.0, 62.0, 125.0]\nphases = [2.2, 0.7, 5.1]") +
            "\namplitude = 6.0\n";
  return EmptyCase(rig, {{"pushed", text, false, false}});
}

/// The measured case: of a machine with the effect `truth`; only the readings at A count, their
/// floors are the noise.
struct PushedRotor {
  explicit PushedRotor(const EffectInstance& truth) : data(PushedCase()) {
    Hypothesis machine = Hypothesis::Base(data.rig);
    machine.rig.effects.push_back(truth);
    const Record run = CaseModel(data).Simulated(machine, 0, false, 1);
    CaseRecord& record = data.records[0];
    for (std::size_t k = 0; k < record.data.channels.size(); ++k) {
      Channel& ch = record.data.channels[k];
      record.quality[k].use = ch.name == "A.x" || ch.name == "A.y";
      for (std::size_t i = 0; i < ch.samples.size(); ++i)
        ch.samples[i] = run.Find(ch.name)->samples[i] +
                        kReadingNoise * Normal(5, static_cast<std::uint32_t>(k), i);
    }
    model = std::make_unique<CaseModel>(data);
    for (Target& t : model->targets()) t.floor = kReadingNoise;
  }

  Case data;
  std::unique_ptr<CaseModel> model;
};

}  // namespace ambrig
