#include "effects/bus_supply.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

// What a rectifier leaks, of its forward conductance: a bus without a capacitance stays finite.
constexpr double kLeak = 1e-3;
// Beside a choke less is none: its ringing is far above the switching frequency [F].
constexpr double kLeastCapacitance = 1e-9;

/// exp(-a h) cos(w h) and exp(-a h) sin(w h)/w of w² = `square`, which may be negative.
struct Decay {
  double even, odd;
};

Decay DecayOver(double h, double a, double square) {
  if (square >= 0) {
    const double w = std::sqrt(square), decay = std::exp(-a * h);
    return {decay * std::cos(w * h), w * h > 1e-8 ? decay * std::sin(w * h) / w : decay * h};
  }
  const double s = std::sqrt(-square);
  const double slow = std::exp((s - a) * h), fast = std::exp(-(s + a) * h);
  return {0.5 * (slow + fast), s * h > 1e-8 ? 0.5 * (slow - fast) / s : slow * h};
}

}  // namespace

double BusSupply::ResistanceOf(bool backward) const {
  return backward ? resistance / std::max(1 - rectification, kLeak) : resistance;
}

void BusSupply::Advance(double drawn, double h) {
  if (inductance > 0)
    AdvanceChoke(drawn, h);
  else
    AdvanceCapacitor(drawn, h);
  voltage = stored + series_resistance * (current - drawn);
}

void BusSupply::AdvanceCapacitor(double drawn, double h) {
  const bool backward =
      capacitance > 0 ? source - stored + series_resistance * drawn < 0 : drawn < 0;
  const double r = ResistanceOf(backward);
  const double loop = r + series_resistance, settled = source - r * drawn;
  const double keep = capacitance > 0 ? std::exp(-h / (loop * capacitance)) : 0;
  stored = settled + (stored - settled) * keep;
  current = (source - stored + series_resistance * drawn) / loop;
}

// Distances from where they settle, y = (i - i_drawn, U_C - E + r i_drawn), follow dy/dt = A y.
// With a = (r + r_C)/(2 L) and w² = 1/(L C) - a²,
//   exp(A h) = exp(-a h) (cos(w h) + sin(w h)/w (A + a)).
void BusSupply::AdvanceChoke(double drawn, double h) {
  const double c = std::max(capacitance, kLeastCapacitance);
  const double r = ResistanceOf(current < 0);
  const double settled = source - r * drawn;
  const double a = (r + series_resistance) / (2 * inductance);
  const Decay d = DecayOver(h, a, 1 / (inductance * c) - a * a);
  const double i = current - drawn, u = stored - settled;
  current = drawn + d.even * i - d.odd * (a * i + u / inductance);
  stored = settled + d.even * u + d.odd * (a * u + i / c);
}

}  // namespace ambrig
