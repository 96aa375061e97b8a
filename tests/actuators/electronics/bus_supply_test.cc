// The bus behind its supply's impedance against closed forms.
#include "actuators/electronics/bus_supply.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"

namespace ambrig {
namespace {

BusSupply Supply(double resistance, double inductance, double capacitance) {
  BusSupply bus{100, resistance, inductance, capacitance, 100, 0};
  return bus;
}

TEST(BusSupply, SettlesAtWhatTheResistanceLeaves) {
  for (const double inductance : {0.0, 4e-4}) {
    BusSupply bus = Supply(0.5, inductance, 1e-3);
    for (int k = 0; k < 20000; ++k) bus.Step(1e-5, 6);
    EXPECT_NEAR(bus.voltage, 97, 1e-9);
    if (inductance > 0) {
      EXPECT_NEAR(bus.current, 6, 1e-9);
    }
  }
}

TEST(BusSupply, WithoutInductanceItFallsWithRC) {
  BusSupply bus = Supply(0.5, 0, 1e-3);
  bus.Step(3e-4, 6);
  EXPECT_NEAR(bus.voltage, 97 + 3 * std::exp(-0.6), 1e-12);
}

// Hardly damped, a step of current makes U_s - U = I sqrt(L/C) sin(t/sqrt(LC)).
TEST(BusSupply, AnInductanceRings) {
  const double L = 4e-4, C = 3.3e-3, w = 1 / std::sqrt(L * C);
  BusSupply bus = Supply(1e-9, L, C);
  const double quarter = 0.5 * kPi / w;
  for (int k = 0; k < 50; ++k) bus.Step(quarter / 50, 6);
  EXPECT_NEAR(100 - bus.voltage, 6 * std::sqrt(L / C), 1e-6);
  EXPECT_NEAR(bus.current, 6, 1e-6);
}

// Exact: the same whatever the steps, under-damped, critical and over-damped.
TEST(BusSupply, OneStepIsManySteps) {
  const double C = 1e-3, L = 4e-4, critical = 2 * std::sqrt(L / C);
  for (const double resistance : {0.3 * critical, critical, 5 * critical}) {
    BusSupply one = Supply(resistance, L, C), many = one;
    one.Step(2e-3, 4);
    for (int k = 0; k < 64; ++k) many.Step(2e-3 / 64, 4);
    EXPECT_NEAR(one.voltage, many.voltage, 1e-9) << resistance;
    EXPECT_NEAR(one.current, many.current, 1e-9) << resistance;
  }
}

// Much smaller than what R and C filter, an inductance does not show.
TEST(BusSupply, ATinyInductanceIsNone) {
  BusSupply with = Supply(0.5, 1e-9, 1e-3), without = Supply(0.5, 0, 1e-3);
  for (BusSupply* bus : {&with, &without}) bus->Step(1e-4, 6);
  EXPECT_NEAR(with.voltage, without.voltage, 1e-5);
}

}  // namespace
}  // namespace ambrig
