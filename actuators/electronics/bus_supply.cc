#include "actuators/electronics/bus_supply.h"

#include <cmath>

namespace ambrig {

namespace {

/// e^{-a h} times the even part of the flow of a second-order system, and its odd part over ω:
/// s² + 2 a s + w2 = 0.
struct SecondOrderFlow {
  double even, odd;
  SecondOrderFlow(double a, double w2, double h) {
    const double square = w2 - a * a, w = std::sqrt(std::abs(square));
    if (square > 0) {
      even = std::exp(-a * h) * std::cos(w * h);
      odd = std::exp(-a * h) * std::sin(w * h) / w;
    } else if (square < 0) {  // two decays; a > w
      const double slow = std::exp((w - a) * h), fast = std::exp(-(w + a) * h);
      even = 0.5 * (slow + fast);
      odd = 0.5 * (slow - fast) / w;
    } else {
      even = std::exp(-a * h);
      odd = h * even;
    }
  }
};

}  // namespace

void BusSupply::Step(double h, double drawn) {
  const double settled = source - resistance * drawn;
  if (capacitance <= 0 || inductance <= 0) {
    const double keep = capacitance > 0 ? std::exp(-h / (resistance * capacitance)) : 0;
    voltage = settled + (voltage - settled) * keep;
    return;
  }
  const double a = 0.5 * resistance / inductance;
  const SecondOrderFlow flow(a, 1 / (inductance * capacitance), h);
  // deviations from what would settle: (a I + A) x is odd, A the rates above
  const double i = current - drawn, u = voltage - settled;
  current = drawn + flow.even * i + flow.odd * (-a * i - u / inductance);
  voltage = settled + flow.even * u + flow.odd * (a * u + i / capacitance);
}

}  // namespace ambrig
