#include "core/record/units.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/errors.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using testing::ErrorText;

TEST(Units, FactorsToSi) {
  const double pi = std::numbers::pi;
  const struct {
    const char *from, *to;
    double factor;
  } cases[] = {{"m", "m", 1},
               {"mm", "m", 1e-3},
               {"um", "m", 1e-6},
               {"nm", "m", 1e-9},
               {"kN", "N", 1e3},
               {"mN", "N", 1e-3},
               {"mA", "A", 1e-3},
               {"mV", "V", 1e-3},
               {"deg", "rad", pi / 180},
               {"rpm", "rad/s", pi / 30},
               {"Hz", "rad/s", 2 * pi},
               {"ms", "s", 1e-3},
               {"us", "s", 1e-6},
               {"degC", "K", 1},
               {"%", "-", 1e-2},
               {"mohm", "ohm", 1e-3},
               {"mH", "H", 1e-3},
               {"g", "kg", 1e-3},
               {"kg m2", "kg m2", 1},
               {"N s/m", "N s/m", 1}};
  for (const auto& c : cases) EXPECT_DOUBLE_EQ(UnitFactor(c.from, c.to), c.factor) << c.from;
  EXPECT_DOUBLE_EQ(3000 * UnitFactor("rpm", "rad/s"), 50 * UnitFactor("Hz", "rad/s"));
}

TEST(Units, SpellingsOfOneUnit) {
  for (const char* micro : {"um", "\u00b5m", "\u03bcm", " um "})
    EXPECT_EQ(UnitFactor(micro, "m"), 1e-6) << micro;
  EXPECT_EQ(UnitFactor("m\u03a9", "ohm"), 1e-3);
  EXPECT_EQ(UnitFactor("\u00b0C", "K"), 1);
  EXPECT_DOUBLE_EQ(UnitFactor("\u00b0", "rad"), std::numbers::pi / 180);
  EXPECT_EQ(UnitFactor("kg m^2", "kg m2"), 1);
  EXPECT_EQ(UnitFactor("kg\u00b7m\u00b2", "kg m2"), 1);
  EXPECT_EQ(UnitFactor("N  s / m", "N s/m"), 1);
  EXPECT_EQ(UnitFactor("W  m2", "W m^2"), 1);  // outside the table, but the same text
}

TEST(Units, WrongOnesAreRefusedWithWhatIsAllowed) {
  const auto error = [](const char* from, const char* to, const char* where = "") {
    return ErrorText<InputError>([&] { UnitFactor(from, to, where); });
  };
  EXPECT_EQ(error("um", "A"), "unit um, allowed A, mA, uA");
  EXPECT_EQ(error("inch", "m", "case.toml:9"), "case.toml:9: unit inch, allowed m, mm, um, nm");
  EXPECT_EQ(error("", "m"), "unit missing, allowed m, mm, um, nm");
  EXPECT_EQ(error("M", "m"), "unit M, allowed m, mm, um, nm");  // capitals mean something
  EXPECT_EQ(error("N", "N s/m"), "unit N, allowed N s/m");
}

TEST(Units, ConvertToSiConvertsEveryChannel) {
  Record r{1.0, 0.0};
  r.channels = {{"A.x", "\u00b5m", {1, -2}},
                {"omega", "rpm", {60, 0}},
                {"q", "", {5, 6}},
                {"A.x", "furlong", {7, 8}},
                {"f", "Hz", {3, 4}}};
  ConvertToSi(r);
  EXPECT_EQ(r.channels[0].unit, "m");
  EXPECT_EQ(r.channels[0].samples[1], -2e-6);
  EXPECT_EQ(r.channels[1].unit, "rad/s");
  EXPECT_DOUBLE_EQ(r.channels[1].samples[0], 2 * std::numbers::pi);
  EXPECT_EQ(r.channels[2].samples[0], 5);
  EXPECT_EQ(r.channels[3].samples[0], 7);
  EXPECT_EQ(r.channels[4].unit, "Hz");
  EXPECT_EQ(r.channels[4].samples[0], 3);
}

}  // namespace
}  // namespace ambrig
