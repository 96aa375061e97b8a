/// The regulators of eight coils at once give the bits of eight regulators.
#include "control/current/current_regulators.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambrig {
namespace {

AmplifierParameters Amplifier() {
  AmplifierParameters a;
  a.bus_voltage = 48;
  a.switching_frequency = 25e3;
  a.kp = 100;
  a.ki = 3000;
  a.i_max = 10;
  return a;
}

/// A walk of set-points and feedbacks; the wide one drives duties beyond their limits.
void ExpectTheSame(const AmplifierParameters& a, int coils, double width) {
  CurrentRegulators together(a);
  CurrentRegulator one[kLanes];
  for (int j = 0; j < coils; ++j) {
    one[j] = CurrentRegulator(a);
    one[j].HoldCurrent(1 + 0.3 * j, 0.5);
    together.HoldCurrent(static_cast<std::size_t>(j), 1 + 0.3 * j, 0.5);
  }
  Lane duty;
  for (int k = 0; k < 400; ++k) {
    Lane set, feedback;
    for (int j = 0; j < kLanes; ++j) {
      set[j] = 2 + width * std::sin(0.3 * k + j);
      feedback[j] = 2 + width * std::sin(0.3 * k + j - 0.2);
    }
    together.Duties(set, feedback, coils, &duty);
    for (int j = 0; j < kLanes; ++j)
      EXPECT_EQ(duty[j], j < coils ? one[j].Duty(set[j], feedback[j]) : 0) << k << " " << j;
  }
  for (int j = 0; j < coils; ++j)
    EXPECT_EQ(together[static_cast<std::size_t>(j)].integral(), one[j].integral()) << j;
}

TEST(CurrentRegulators, AsOneByOne) {
  AmplifierParameters a = Amplifier();
  for (const bool voltage : {false, true})
    for (const Modulation m : {Modulation::kBiState, Modulation::kTriState})
      for (const int coils : {8, 4, 1})
        for (const double width : {0.01, 3.0}) {
          a.voltage_mode = voltage;
          a.modulation = m;
          ExpectTheSame(a, coils, width);
        }
}

TEST(CurrentRegulators, OneCoilIsSetAlone) {
  const AmplifierParameters a = Amplifier();
  CurrentRegulators all(a);
  all.ResetToLowerLimit();
  const double lowest = all[0].integral();
  all.SetIntegral(3, -1.5);
  for (std::size_t j = 0; j < kLanes; ++j) EXPECT_EQ(all[j].integral(), j == 3 ? -1.5 : lowest);
}

}  // namespace
}  // namespace ambrig
