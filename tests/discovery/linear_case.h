#pragma once
/// Cases whose model is linear in what is unknown: a clamped rotor, of which only the position
/// readings of bearing A are compared. A reading is gain * position + offset, exactly, so that
/// fits, signatures and rankings have answers in closed form.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "discovery/search/fit.h"
#include "effects/catalogue.h"
#include "rig/rig_file.h"

namespace ambrig {

struct LinearCase {
  static constexpr double kFloor = 1e-6;  // [m]
  static constexpr std::size_t kRows = 50;

  /// One record per position x [m] of A.x (A.y is held at 0), the last one kept back for
  /// validation, "measured" with the gain and offset [m] given.
  LinearCase(const std::vector<double>& positions, double gain, double offset)
      : x(positions), data(Make(positions, gain, offset)), model(data) {
    for (Target& t : model.targets()) t.floor = kFloor;
  }

  static Case Make(const std::vector<double>& positions, double gain, double offset) {
    Case c;
    c.rig = ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
    c.rig.effects.clear();
    c.rig.tolerances.clear();
    for (const double& at : positions) {
      CaseRecord r;
      r.data_file = fmt::format("at {} m", at);
      r.scenario = ReadScenarioText(
          fmt::format(
              "name = \"clamped\"\nrig = \"rig.toml\"\nduration = 0.004\nrecord_rate = 12500.0\n"
              "noise = false\nfault_tolerance = false\n[start]\nstate = \"clamped\"\n"
              "position = {{ A = [{0}, 0.0], B = [{0}, 0.0] }}\n"
              "[speed]\nprofile = [[0.0, 0.0], [0.004, 0.0]]\n",
              at),
          "clamped.toml", c.rig);
      r.validate = &at == &positions.back();
      r.data.rate = 12500;
      r.data.channels = {{"A.x", "m", std::vector<double>(kRows, gain * at + offset)},
                         {"A.y", "m", std::vector<double>(kRows, 0)}};
      for (const Channel& ch : r.data.channels)
        r.quality.push_back({ch.name, "good", true, std::vector<char>(kRows, 1), 0, 0});
      c.records.push_back(std::move(r));
    }
    return c;
  }

  static EffectInstance Gain(double gain) {
    EffectInstance e = MakeInstance(EffectNamed("sensor-gain"), "A.x");
    e.Set("gain", gain);
    return e;
  }
  static EffectInstance Offset(double offset) {
    EffectInstance e = MakeInstance(EffectNamed("sensor-offset"), "A.x");
    e.Set("offset", offset);
    return e;
  }
  Hypothesis With(const std::vector<EffectInstance>& effects) const {
    Hypothesis h = Hypothesis::Base(data.rig);
    for (const EffectInstance& e : effects) h.AddEffect(e);
    return h;
  }

  /// The rig file as it is, as what a screening starts from.
  FitResult Base() const {
    FitResult base = Fit(model, With({}), {});
    base.jacobian = Eigen::MatrixXd(static_cast<Eigen::Index>(model.size()), 0);
    return base;
  }
  std::size_t fit_records() const { return x.size() - 1; }

  const std::vector<double> x;
  const Case data;
  CaseModel model;
};

}  // namespace ambrig
