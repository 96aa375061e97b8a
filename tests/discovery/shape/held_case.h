#pragma once
/// Bearing A held off centre, four of its coils ramped: currents and forces tell the law of its
/// iron.
#include "core/math/noise.h"
#include "discovery/experiment/examination.h"
#include "effects/catalogue.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {

inline constexpr double kFloorOfForce = 0.05, kFloorOfCurrent = 0.002;  // [N], [A]

/// `data` is filled by the caller.
inline Case HeldCase() {
  RigParameters rig = ReferenceRig();
  rig.tolerances.clear();
  std::string text =
      "name = \"held\"\nrig = \"rig.toml\"\nduration = 0.02\nrecord_rate = 12500.0\nseed = 1\n"
      "noise = false\nfault_tolerance = false\n[start]\nstate = \"clamped\"\n"
      "position = { A = [3e-5, 0.0], B = [0.0, 0.0] }\n[speed]\nprofile = [[0.0, 0.0], [0.02, "
      "0.0]]\n";
  for (int j = 1; j <= 8; ++j) {
    text += "[[excitation]]\ntarget = \"A.coil" + std::to_string(j) +
            "\"\nport = \"current\"\nkind = \"step\"\nstart = 0.0\nstop = 0.02\namplitude = 1.0\n";
    if (j < 3 || j > 6) continue;
    text += "[[excitation]]\ntarget = \"A.coil" + std::to_string(j) +
            "\"\nport = \"current\"\nkind = \"ramp\"\nstart = 0.001\nstop = 0.019\namplitude = " +
            std::to_string(0.8 * rig.amplifier.i_max - 1) + "\n";
  }
  return EmptyCase(rig, {{"held", text, false, false}});
}

/// The case with what a rig with `truth`'s effects would have measured, and noise.
inline void Measure(const CaseModel& model, const Hypothesis& truth, Case& c) {
  const Record run = model.Simulated(truth, 0, false, 1);
  std::uint32_t stream = 0;
  for (Channel& ch : c.records[0].data.channels) {
    ++stream;
    const double noise = ch.name.find(".f") != std::string::npos ? kFloorOfForce : kFloorOfCurrent;
    for (std::size_t k = 0; k < ch.samples.size(); ++k)
      ch.samples[k] = run.Find(ch.name)->samples[k] + noise * Normal(5, stream, k);
  }
}

/// The measured case: only currents and forces of A count, their floors are the noise.
struct HeldIron {
  explicit HeldIron(const std::vector<EffectInstance>& effects) : data(HeldCase()) {
    const CaseModel empty(data);
    truth = Hypothesis::Base(data.rig);
    truth.rig.effects.insert(truth.rig.effects.end(), effects.begin(), effects.end());
    Measure(empty, truth, data);
    for (Channel& ch : data.records[0].data.channels)
      if (ch.name[0] != 'A' || (ch.name[2] != 'i' && ch.name[2] != 'f'))
        data.records[0]
            .quality[static_cast<std::size_t>(&ch - data.records[0].data.channels.data())]
            .use = false;
    model = std::make_unique<CaseModel>(data);
    for (Target& t : model->targets())
      t.floor =
          data.records[0].data.channels[t.channel].name[2] == 'f' ? kFloorOfForce : kFloorOfCurrent;
  }
  Case data;
  Hypothesis truth;
  std::unique_ptr<CaseModel> model;
};

inline EffectInstance IronAtA(const std::string& name,
                              const std::vector<std::pair<std::string, double>>& values) {
  EffectInstance e = MakeInstance(EffectNamed(name), "A");
  for (const auto& [parameter, value] : values) e.Set(parameter, value);
  return e;
}

}  // namespace ambrig
