#pragma once
/// A static table: what a bearing does at a standing position with standing currents, by the
/// magnetics of the hypothesis with all its effects (iron laws as after a slow rise of the
/// current).
///
///   A.fx, A.fy   force on the rotor at those currents                        [N]
///   A.lambda1    linkage of coil 1                                           [Wb]
///   A.L1         its slope over the coil's own current, all others held      [H]
///   A.L1@f, A.R1@f  inductance and resistance in series that an LCR meter reads at f Hz  [H],
///   [ohm]
///
/// A column `frequency` [Hz] among the inputs says f row by row. The meter's current is 1 mA: the
/// iron laws are stepped through it, so that eddy currents and hysteresis show.
///
/// Positions are those of the shaft at the magnets and currents those of the coils: what they were
/// set with is a gauge of the bench, not the rig's sensors.
#include "actuators/magnetics/lane.h"
#include "discovery/model/record_predictor.h"

namespace ambrig {

struct BearingPlant;

class StaticPredictor : public RecordPredictor {
 public:
  StaticPredictor(const Case& c, const CaseRecord& record);
  bool Predict(const RigParameters& rig, std::vector<std::vector<double>>& columns) const override;

 private:
  enum class Quantity { kForce, kLinkage, kInductance, kResistance };
  struct Output {
    std::size_t bearing = 0;
    Quantity quantity = Quantity::kForce;
    int index = 0;         // direction (0 x, 1 y, 2 z) or coil
    double frequency = 0;  // [Hz] of an impedance; 0: at rest
  };
  /// Of one bearing in one row: where the shaft is held and with which currents.
  struct Setting {
    double x = 0, y = 0;
    Lane current;
    double frequency = 0;  // [Hz]
  };
  Setting SettingOf(std::size_t bearing, std::size_t row) const;
  static double Value(const Output& o, BearingPlant& bearing, const Setting& s);

  const CaseRecord& record_;
  std::vector<Output> outputs_;
  // per bearing: columns of its axes and coils among the inputs, nullptr: not there
  struct Inputs {
    std::vector<const Channel*> axes, coils;
    double x = 0, y = 0;  // of the scenario
    Lane current;         // of the scenario
  };
  std::vector<Inputs> inputs_;
  const Channel* frequency_ = nullptr;
};

}  // namespace ambrig
