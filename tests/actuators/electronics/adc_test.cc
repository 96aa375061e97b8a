/// The analogue-to-digital converter.
#include "actuators/electronics/adc.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

// Signed, 12 bits over ±10 A: 4.88 mA a step, nearest code, clipped.
TEST(Adc, QuantiserRoundsAndClips) {
  const Quantiser q(12, 10);
  const double lsb = 20.0 / 4096;
  EXPECT_EQ(q(0.4999 * lsb), 0);
  EXPECT_EQ(q(0.5001 * lsb), lsb);
  EXPECT_EQ(q(-0.5001 * lsb), -lsb);
  EXPECT_EQ(q(1e3), 10 - lsb);
  EXPECT_EQ(q(-1e3), -10);
}

}  // namespace
}  // namespace ambrig
