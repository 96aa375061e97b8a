#include "control/current/current_regulator.h"

namespace ambrig {

double CurrentRegulator::VoltageOfDuty(double d) const {
  return SwingsBothWays(p_->modulation) ? 2 * p_->bus_voltage * (d - 0.5) : p_->bus_voltage * d;
}

void CurrentRegulator::ResetToLowerLimit() {
  integral_ = p_->voltage_mode ? 0 : VoltageOfDuty(p_->duty_min);
}

void CurrentRegulator::HoldCurrent(double current, double resistance) {
  if (current <= kInterruptedCurrent && p_->quadrants < 3 && p_->modulation != Modulation::kIdeal)
    return ResetToLowerLimit();
  const double u_d = p_->bus_voltage, ir = current * resistance;
  double d = ir / u_d;
  if (p_->modulation == Modulation::kBiState) {
    const double off = p_->quadrants < 3 ? u_d + 2 * p_->diode_drop : u_d - 2 * p_->switch_drop;
    d = (ir + off) / (off + u_d - 2 * p_->switch_drop);
  } else if (p_->modulation == Modulation::kTriState) {
    // on for 2d - 1 of the period, else wheel
    const double wheel = p_->switch_drop + p_->diode_drop;
    d = 0.5 + 0.5 * (ir + wheel) / (u_d - 2 * p_->switch_drop + wheel);
  }
  integral_ = p_->voltage_mode ? 0 : VoltageOfDuty(d);
}

}  // namespace ambrig
