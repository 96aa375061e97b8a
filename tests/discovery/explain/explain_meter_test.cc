// Readings of an LCR meter over stroke and frequency, from closed forms of the iron: which eddy
// currents they show.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <complex>
#include <functional>
#include <string>

#include "core/math/noise.h"
#include "discovery/explain/explain.h"
#include "tests/discovery/bench_case.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;
using testing::CaseOf;
using testing::TemporaryFolder;
using testing::WriteBytes;

const char* const kPlunger = R"(name = "plunger"
gravity = [0.0, -9.81, 0.0]
[rotor]
kind = "point"
mass = 0.02
[amplifier]
modulation = "chopper"
bus_voltage = 12.0
switching_frequency = 20000.0
duty_limits = [0.0, 1.0]
bandwidth = 500.0
adc_samples_per_period = 18
adc_bits = 12
adc_range = 0.5
current_noise = 3.0e-4
i_max = 0.3
[controller]
kind = "pid"
rate = 1000.0
kp = 100.0
kd = 1.0
ki = 100.0
derivative_time_constant = 5.0e-3
f_max = 1.0
bias_current = 0.2
[bearings.M]
kind = "opposed"
coils = 1
angle_deg = 90.0
gap = 0.002
resistance = { value = 52.0, sd = 0.5 }
inductance_far = { value = 4.2e-3, sd = 2.0e-4 }
inductance_near = { value = 0.11, sd = 5.0e-3 }
gap_constant = { value = 0.005, sd = 3.0e-4 }
sensor = { noise = 1.0e-6 }
)";

/// Case of a table of a coil whose gap has 1 + T(f) times its reluctance where the body works, 2 mm
/// off:
///   l(g) = L_0/(1 + g/g_c)
///   L = L_inf + l/(1 + T l/l(2 mm))
/// Readings are good to half a per cent.
Case MeterCase(const TemporaryFolder& folder, const std::function<Complex(double f)>& T) {
  const double far = 4.1e-3, near = 0.113, constant = 5.1e-3, sd = 0.005;
  const auto added = [&](double g) { return near / (1 + g / constant); };
  const double frequencies[] = {50, 200, 1000, 5000, 20000};
  std::string table = "gap [mm]", channels;
  for (const double f : frequencies) {
    table += fmt::format(",L_{0:.0f} [H],R_{0:.0f} [ohm]", f);
    channels +=
        fmt::format("\"M.L1@{0:.0f}\" = \"L_{0:.0f}\"\n\"M.R1@{0:.0f}\" = \"R_{0:.0f}\"\n", f);
  }
  std::uint64_t draw = 0;
  for (const double g : {0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 4e-3}) {
    table += fmt::format("\n{}", 1e3 * g);
    for (const double f : frequencies) {
      const Complex L = far + added(g) / (1.0 + T(f) * added(g) / added(2e-3));
      table += fmt::format(",{:.9g}", L.real() * (1 + sd * Normal(1, 2, draw++)));
      table += fmt::format(
          ",{:.9g}", (52 - 6.283185307179586 * f * L.imag()) * (1 + sd * Normal(1, 2, draw++)));
    }
  }
  WriteBytes(folder.File("rig.toml"), kPlunger);
  WriteBytes(folder.File("table.csv"), table + "\n");
  return CaseOf(
      folder,
      "[[record]]\nkind = \"static\"\ndata = \"table.csv\"\naccuracy = 0.005\n"
      "[record.channels]\n\"M.x\" = { column = \"gap\", gain = -1.0, offset = 2.0e-3 }\n" +
          channels,
      folder.File("rig.toml"));
}

Explanation Explained(const std::function<Complex(double f)>& T) {
  const TemporaryFolder folder;
  ExplainOptions o;
  o.candidates = 3;
  o.rounds = 1;
  return Explain(MeterCase(folder, T), o);
}

Complex HalfOrder(double f, double cutoff) { return std::sqrt(Complex(0, f / cutoff)); }

// A guide tube: one time constant.
TEST(ExplainMeter, ASleeveIsNamedWithItsCutoff) {
  for (const double cutoff : {120.0, 450.0, 6000.0}) {
    const Explanation e = Explained([&](double f) { return Complex(0, f / cutoff); });
    EXPECT_EQ(e.verdict, ExplanationVerdict::kEffect) << cutoff;
    ASSERT_FALSE(e.adopted.empty()) << cutoff;
    EXPECT_EQ(e.adopted[0].name, "eddy-sleeve") << cutoff;
    EXPECT_NEAR(e.adopted[0].Value("cutoff") / cutoff, 1, 0.03);
    EXPECT_LT(e.final_ratio_fit, 1.3);
  }
}

// Solid iron, from the corners of a massive core to those of a thin one.
TEST(ExplainMeter, ThickIronIsNamedWithItsCutoff) {
  for (const double cutoff : {20.0, 300.0, 5000.0}) {
    const Explanation e = Explained([&](double f) { return HalfOrder(f, cutoff); });
    EXPECT_EQ(e.verdict, ExplanationVerdict::kEffect) << cutoff;
    ASSERT_FALSE(e.adopted.empty()) << cutoff;
    EXPECT_EQ(e.adopted[0].name, "eddy-currents") << cutoff;
    EXPECT_NEAR(e.adopted[0].Value("cutoff") / cutoff, 1,
                0.05);                         // two sd at 20 Hz, the least known
    EXPECT_EQ(e.adopted[0].Value("path"), 0);  // no thickness shows
    EXPECT_LT(e.final_ratio_fit, 1.3);
  }
}

// Laminations whose corner, 127 Hz, lies within the meter's band: thickness and cutoff are both
// told. With path p the reluctance of the gap is g_c + g long, so that ρ = p/(g_c + g) and z² = j
// ω/(ρ² ω_c).
TEST(ExplainMeter, LaminationsKeepTheirThickness) {
  const double path = 8e-4, cutoff = 1e4, rho = path / 7.1e-3;
  const Explanation e = Explained([&](double f) {
    const Complex z = std::sqrt(Complex(0, f / cutoff)) / rho;
    return rho * (z / std::tanh(z) - 1.0);
  });
  EXPECT_EQ(e.verdict, ExplanationVerdict::kEffect);
  ASSERT_FALSE(e.adopted.empty());
  EXPECT_EQ(e.adopted[0].name, "eddy-currents");
  // four times the sd that the fit tells
  EXPECT_NEAR(e.adopted[0].Value("cutoff") / cutoff, 1, 0.03);
  EXPECT_NEAR(e.adopted[0].Value("path") / path, 1, 0.06);
  EXPECT_LT(e.final_ratio_fit, 1.3);
}

// Laws of neither form: an order of 0.6 (measured orders lie between 0.4 and 0.7), a sleeve round
// thick iron.
TEST(ExplainMeter, OtherLawsAreEddyCurrentsToo) {
  const std::function<Complex(double)> laws[] = {
      [](double f) { return std::pow(Complex(0, f / 400), 0.6); },
      [](double f) { return HalfOrder(f, 2000) + Complex(0, f / 900); }};
  for (const auto& law : laws) {
    const Explanation e = Explained(law);
    ASSERT_FALSE(e.ranking.empty());
    EXPECT_TRUE(e.ranking[0].effect.name.starts_with("eddy-")) << e.ranking[0].effect.name;
    EXPECT_EQ(e.verdict, ExplanationVerdict::kEffect);
  }
}

// The numbers of the coil are off by up to half of their sd, and nothing else.
TEST(ExplainMeter, IronWithoutLossesNeedsNoEffect) {
  const Explanation e = Explained([](double) { return Complex(0); });
  EXPECT_EQ(e.verdict, ExplanationVerdict::kParameters);
  EXPECT_TRUE(e.adopted.empty());
}

}  // namespace
}  // namespace ambrig
