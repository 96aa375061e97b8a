#pragma once
/// The supply of the amplifiers as they see it.

namespace ambrig {

/// Stiff, or a source behind a resistance (and a choke) that feeds a capacitor at the amplifiers:
///   L di/dt = E - r i - U,   C dU_C/dt = i - i_drawn,   U = U_C + r_C (i - i_drawn)
struct BusSupply {
  double source = 0;             // E [V]
  double resistance = 0;         // r of a current to the amplifiers [ohm], 0: stiff
  double inductance = 0;         // L [H], 0: none
  double capacitance = 0;        // C [F], 0: none
  double series_resistance = 0;  // r_C, of the capacitor [ohm]
  /// Share of the conductance that the source lacks for a current back into it: 0 takes back as it
  /// gives, 1 is a rectifier.
  double rectification = 0;
  double voltage = 0;  // U at the amplifiers [V]
  double stored = 0;   // state U_C [V]
  double current = 0;  // i; a state where there is a choke [A]

  bool stiff() const { return resistance <= 0; }
  /// A source of so many volts, the capacitor charged.
  void Start(double volts) { source = voltage = stored = volts; }
  /// The state after `h` [s] in which the amplifiers draw `drawn` [A]. Exact for a current of the
  /// source that keeps its direction.
  void Advance(double drawn, double h);

 private:
  double ResistanceOf(bool backward) const;
  void AdvanceCapacitor(double drawn, double h);
  void AdvanceChoke(double drawn, double h);
};

}  // namespace ambrig
