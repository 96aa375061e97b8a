#pragma once
/// The current regulators of a bearing's coils: one nominal amplifier, an integral each.
#include "actuators/magnetics/lane.h"
#include "control/current/current_regulator.h"

namespace ambrig {

class CurrentRegulators {
 public:
  CurrentRegulators() = default;
  /// `nominal` must outlive the regulators.
  explicit CurrentRegulators(const AmplifierParameters& nominal)
      : nominal_(&nominal), any_(nominal) {}

  /// That of coil j as it stands.
  CurrentRegulator operator[](std::size_t j) const {
    CurrentRegulator one = any_;
    one.set_integral(integral_.v[j]);
    return one;
  }
  void SetIntegral(std::size_t j, double volts) { integral_.v[j] = volts; }
  /// CurrentRegulator::HoldCurrent of coil j.
  void HoldCurrent(std::size_t j, double current, double resistance);
  /// Of all coils.
  void ResetToLowerLimit();
  /// CurrentRegulator::Duty of the first `coils`; the other lanes of `duty` stay.
  void Duties(const Lane& set_point, const Lane& feedback, int coils, Lane* duty);

 private:
  const AmplifierParameters* nominal_ = nullptr;
  CurrentRegulator any_;  // without its integral
  Lane integral_;         // [V]
};

}  // namespace ambrig
