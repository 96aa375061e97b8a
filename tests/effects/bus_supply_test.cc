// The supply behind a resistance, a choke and a capacitor against fine steps of the equations, and
// what a rectifier does with current that comes back.
#include "effects/bus_supply.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace ambrig {
namespace {

constexpr double kSample = 2.5e-6;  // a sample of the switching engine [s]

/// What the amplifiers draw at time t: a step, then a swing that returns current.
double Drawn(double t) { return t < 1e-3 ? 20 : 20 * std::cos(2 * M_PI * 700 * (t - 1e-3)); }

BusSupply Supply(double inductance, double series_resistance) {
  BusSupply bus;
  bus.resistance = 0.35;
  bus.inductance = inductance;
  bus.capacitance = 1.3e-3;
  bus.series_resistance = series_resistance;
  bus.Start(100);
  return bus;
}

/// Voltage at the amplifiers at `until` [s], the draw of each sample held, by Runge-Kutta steps of
/// a hundredth.
double ByFineSteps(const BusSupply& of, double until) {
  using State = std::array<double, 2>;  // i, U_C
  const double r = of.resistance, l = of.inductance, c = of.capacitance, rc = of.series_resistance;
  const auto slope = [&](const State& y, double drawn) -> State {
    return {(of.source - (r + rc) * y[0] + rc * drawn - y[1]) / l, (y[0] - drawn) / c};
  };
  const auto moved = [](const State& y, const State& by, double h) -> State {
    return {y[0] + h * by[0], y[1] + h * by[1]};
  };
  State y = {0, of.source};
  double drawn = 0;
  const double h = kSample / 100;
  for (long long k = 0; k < std::llround(until / kSample); ++k) {
    drawn = Drawn(static_cast<double>(k) * kSample);
    for (int s = 0; s < 100; ++s) {
      const State a = slope(y, drawn), b = slope(moved(y, a, h / 2), drawn),
                  e = slope(moved(y, b, h / 2), drawn), f = slope(moved(y, e, h), drawn);
      for (std::size_t q = 0; q < 2; ++q) y[q] += h / 6 * (a[q] + 2 * b[q] + 2 * e[q] + f[q]);
    }
  }
  return y[1] + rc * (y[0] - drawn);
}

double Advanced(BusSupply bus, double until) {
  for (long long k = 0; k < std::llround(until / kSample); ++k)
    bus.Advance(Drawn(static_cast<double>(k) * kSample), kSample);
  return bus.voltage;
}

TEST(BusSupply, AChokeRingsAndSettlesAsItsEquationsDo) {
  // damping ratios 0.32 and 6.5 with a series resistance, 0.9 without
  for (const BusSupply& bus : {Supply(4e-4, 0.01), Supply(1e-6, 0.01), Supply(5e-5, 0)})
    for (const double until : {3e-4, 1e-3, 4e-3})
      EXPECT_NEAR(Advanced(bus, until), ByFineSteps(bus, until), 1e-7)
          << bus.inductance << ' ' << until;
}

// A choke that vanishes leaves what there is without one.
TEST(BusSupply, IsContinuousInItsChoke) {
  for (const double series : {0.0, 0.02})
    EXPECT_NEAR(Advanced(Supply(1e-10, series), 4e-3), Advanced(Supply(0, series), 4e-3), 1e-4);
}

TEST(BusSupply, WithoutAChokeDecaysWithItsTimeConstant) {
  BusSupply bus = Supply(0, 0.05);
  bus.Advance(20, 1e-4);
  const double settled = 100 - 0.35 * 20;
  const double stored = settled + 7 * std::exp(-1e-4 / (0.4 * 1.3e-3));
  EXPECT_NEAR(bus.stored, stored, 1e-9);
  EXPECT_NEAR(bus.current, (100 - stored + 0.05 * 20) / 0.4, 1e-9);
  EXPECT_NEAR(bus.voltage, stored + 0.05 * (bus.current - 20), 1e-9);
}

// Coils that brake pump a rectified bus by their charge; one that takes current back returns.
TEST(BusSupply, ARectifierKeepsTheChargeThatComesBack) {
  for (const double choke : {0.0, 2e-4}) {
    BusSupply rectified = Supply(choke, 0), open = Supply(choke, 0);
    rectified.rectification = 1;
    for (int k = 0; k < 400; ++k)  // 1 ms
      for (BusSupply* bus : {&rectified, &open}) bus->Advance(-10, kSample);
    EXPECT_NEAR(rectified.voltage - 100, 10 * 1e-3 / 1.3e-3, 0.1) << choke;
    EXPECT_LT(open.voltage - 100, 5) << choke;
    for (int k = 0; k < 2000; ++k)  // 5 ms without a draw
      for (BusSupply* bus : {&rectified, &open}) bus->Advance(0, kSample);
    EXPECT_GT(rectified.voltage - 100, 7) << choke;
    EXPECT_NEAR(open.voltage, 100, 0.1) << choke;
  }
}

// No capacitance at all: algebraic without a choke, finite with a rectifier and with a choke.
TEST(BusSupply, IsFiniteWithoutACapacitance) {
  for (const double choke : {0.0, 1e-4}) {
    BusSupply bus = Supply(choke, 0);
    bus.capacitance = 0;
    bus.rectification = 1;
    for (const double drawn : {10.0, 0.0, -10.0, 5.0}) {
      bus.Advance(drawn, kSample);
      EXPECT_TRUE(std::isfinite(bus.voltage) && std::isfinite(bus.current)) << choke << drawn;
    }
    if (choke == 0) {
      EXPECT_NEAR(bus.voltage, 100 - 0.35 * 5, 1e-9);
    }
  }
}

}  // namespace
}  // namespace ambrig
