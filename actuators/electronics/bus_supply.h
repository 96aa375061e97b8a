#pragma once
/// The supply at the amplifiers: stiff, or a source that feeds a capacitance through a resistance
/// and an inductance,
///
///   L i' = U_s - R i - U,   C U' = i - i_drawn
///
/// Without inductance i = (U_s - U)/R; without capacitance U = U_s - R i_drawn.
namespace ambrig {

struct BusSupply {
  double source = 0;       // U_s [V]
  double resistance = 0;   // [ohm], 0: stiff
  double inductance = 0;   // [H]
  double capacitance = 0;  // [F]
  double voltage = 0;      // U, state [V]
  double current = 0;      // i, state of an inductance [A]

  bool stiff() const { return resistance <= 0; }
  /// Exact over h [s] in which the amplifiers draw a constant current [A].
  void Step(double h, double drawn);
};

}  // namespace ambrig
