// A bus behind an impedance in a run, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/effects/effect_rigs.h"
#include "tests/rig/exact_coils.h"

namespace ambrig {
namespace {

// Settled, the supply delivers the copper loss and the drops: U = U_s - R i_drawn with
// U i_drawn = power of the sixteen coils.
TEST(BusImpedance, SettledBusCarriesTheCopperLoss) {
  RigParameters rig = WithExactCoils(ReferenceRig());
  rig.amplifier.switch_drop = rig.amplifier.diode_drop = 0;
  const double resistance = 0.3, high = 4;
  const RigParameters with =
      WithEffect(rig, "bus-impedance", "rig", {{"resistance", resistance}, {"capacitance", 0.04}});
  const RunResult result = RunText(with, ClampedText(high, 0.1));
  const double bus = TailMean(result.record, "bus", 250);
  // Coils of B are told nothing: they stay at the lower duty limit and draw next to nothing.
  double power = 0;
  for (int j = 1; j <= 8; ++j) {
    const double i = TailMean(result.record, "A.i" + std::to_string(j), 250);
    power += rig.bearings[0].radial.resistance * i * i;
  }
  const double source = rig.amplifier.bus_voltage;
  const double wanted = 0.5 * (source + std::sqrt(source * source - 4 * resistance * power));
  EXPECT_LT(wanted, source - 0.5);
  // Rows show the bus at the start of a period, half its ripple (32 A over 20 us in 40 mF) above
  // the mean: 1.3 % of the sag. Ripple current adds copper loss: (0.2/4)²/3 of it.
  EXPECT_NEAR(bus, wanted, 0.02 * (source - wanted));
}

// Rows of a burst show the bus where it is: of a period's samples the first stands at the crest of
// the ripple, that of the change from feeding to braking coils near its bottom.
TEST(BusImpedance, ABurstShowsTheRippleInsideAPeriod) {
  const double capacitance = 4e-3, high = 4;
  const RigParameters with = WithEffect(WithExactCoils(ReferenceRig()), "bus-impedance", "rig",
                                        {{"resistance", 0.2}, {"capacitance", capacitance}});
  std::string text = ClampedText(high, 0.05);
  const std::string rate = "record_rate = 25000.0";
  text.replace(text.find(rate), rate.size(), "record_rate = 450000.0");
  const RunResult result = RunText(with, text);
  const auto& bus = result.record.Find("bus")->samples;
  const double T = 1 / with.amplifier.switching_frequency;
  // eight coils at `high` and half the duty, with the others at the lower limit
  ASSERT_EQ(bus.size() % 18, 0u);
  const std::size_t last = bus.size() - 18;
  const double crest = bus[last], bottom = *std::min_element(bus.end() - 18, bus.end());
  EXPECT_NEAR(crest - bottom, 8 * high * T / 2 / capacitance, 0.1 * (crest - bottom));
  EXPECT_NEAR(bus[last + 9], bottom, 0.2 * (crest - bottom));
}

}  // namespace
}  // namespace ambrig
