// Each law's own form: amounts at the usual size, powers, orders and symmetries, over several
// draws.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>

#include "discovery/practice/laws/practice_law.h"
#include "effects/formula_parser.h"
#include "effects/law_tables.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

constexpr double kWeight = 40, kReach = 2e-4;  // [N], [m]
constexpr double kTurn = 2 * M_PI;

class LawForm : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  std::vector<EffectInstance> Make(const std::string& id, const std::string& target,
                                   double size = 1) const {
    for (const PracticeLaw& l : PracticeLaws())
      if (l.id == id)
        return l.make({rig_, target, size, kWeight, kReach, PracticeDraw(GetParam(), 7)});
    ADD_FAILURE() << "no law " << id;
    return {};
  }

  /// The formula of a quantity at named values, the others 0.
  static double At(const EffectInstance& e, const std::string& quantity,
                   const std::map<std::string, double>& values) {
    std::vector<std::string> names = {"x", "y", "vx", "vy", "theta", "omega", "t", "bus", "i"};
    std::vector<double> numbers;
    for (const std::string& name : names)
      numbers.push_back(values.contains(name) ? values.at(name) : 0);
    for (const auto& [of, text] : e.formulas)
      if (of == quantity) return FormulaExpression(text, names, of)(numbers.data());
    ADD_FAILURE() << "no " << quantity;
    return 0;
  }
  /// fx + i fy.
  static Complex ForceAt(const EffectInstance& e, std::map<std::string, double> values) {
    return {At(e, "force.x", values), At(e, "force.y", values)};
  }
  /// The part of fx + i fy that turns `order` times with the rotor.
  static Complex Order(const EffectInstance& e, int order) {
    Complex sum = 0;
    constexpr int kSteps = 64;
    for (int k = 0; k < kSteps; ++k) {
      const double theta = kTurn * k / kSteps;
      sum += ForceAt(e, {{"theta", theta}, {"omega", 300}}) * std::polar(1.0, -order * theta);
    }
    return sum / static_cast<double>(kSteps);
  }

  const RigParameters rig_ = ReadRig(AMBRIG_SOURCE_DIR "/examples/reference/rig.toml");
};

// A tenth of the weight at 1000 rad/s, with the square of the speed, more or less by a fifth to six
// tenths a second.
TEST_P(LawForm, GrowingUnbalance) {
  const EffectInstance e = Make("unbalance-growing", "A").at(0);
  const auto size = [&](double omega, double t) {
    return std::abs(ForceAt(e, {{"omega", omega}, {"t", t}, {"theta", 0.3}}));
  };
  EXPECT_NEAR(size(1000, 0), 0.1 * kWeight, 1e-6);
  EXPECT_NEAR(size(500, 0), 0.025 * kWeight, 1e-6);
  const double rate = std::abs(size(1000, 1) / size(1000, 0) - 1);
  EXPECT_GE(rate, 0.2 - 1e-6);
  EXPECT_LE(rate, 0.6 + 1e-6);
  EXPECT_NEAR(std::arg(ForceAt(e, {{"omega", 100}, {"theta", 1}}) / ForceAt(e, {{"omega", 100}})),
              1, 1e-6);
}

TEST_P(LawForm, UnbalanceOfAnotherPower) {
  const EffectInstance e = Make("unbalance-power", "A", 2).at(0);
  const auto size = [&](double omega) { return std::abs(ForceAt(e, {{"omega", omega}})); };
  EXPECT_NEAR(size(1000), 0.2 * kWeight, 1e-5);
  const double power = std::log2(size(1000) / size(500));
  EXPECT_GE(power, 1.8 - 1e-6);
  EXPECT_LE(power, 2.2 + 1e-6);
}

// Twice a turn forward with 5 % of the weight; a tenth to three tenths of it backward and once a
// turn, less at four.
TEST_P(LawForm, CouplingOfManyOrders) {
  const EffectInstance e = Make("coupling-orders", "A").at(0);
  const double f = 0.05 * kWeight, tiny = 1e-6 * f;
  EXPECT_NEAR(std::abs(Order(e, 2)), f, 1e-6);
  for (const int order : {-2, 1}) {
    EXPECT_GE(std::abs(Order(e, order)), 0.1 * f - tiny) << order;
    EXPECT_LE(std::abs(Order(e, order)), 0.3 * f + tiny) << order;
  }
  EXPECT_GE(std::abs(Order(e, 4)), 0.05 * f - tiny);
  EXPECT_LE(std::abs(Order(e, 4)), 0.2 * f + tiny);
  for (const int order : {-4, -1, 0, 3}) EXPECT_LE(std::abs(Order(e, order)), tiny) << order;
}

// Against the rotation, 300 Ip at 1000 rad/s, odd in the speed.
TEST_P(LawForm, DragOfAnotherPower) {
  const EffectInstance e = Make("windage-power", "rig").at(0);
  const auto torque = [&](double omega) { return At(e, "torque", {{"omega", omega}}); };
  EXPECT_NEAR(torque(1000), -300 * rig_.rotor.inertia_polar, 1e-6);
  EXPECT_NEAR(torque(-700), -torque(700), 1e-12);
  const double power = std::log2(torque(1000) / torque(500));
  EXPECT_GE(power, 1.4 - 1e-6);
  EXPECT_LE(power, 2.7 + 1e-6);
}

// A gain of 1 +- 4 % of small movements, bending within the clearance by less than that.
TEST_P(LawForm, GainThatBends) {
  for (const double size : {1.0, 2.0}) {
    const EffectInstance e = Make("gain-bent", "A.y", size).at(0);
    EXPECT_EQ(e.target, "A");
    const auto gain = [&](double y) { return At(e, "reading.y", {{"y", y}}) / y; };
    EXPECT_NEAR(std::abs(gain(1e-9) - 1), 0.04 * size, 1e-6);
    EXPECT_NE(gain(kReach), gain(1e-9));
    EXPECT_LE(std::abs(gain(kReach) - gain(1e-9)), 0.18 * 0.04 * size + 1e-9);
  }
}

TEST_P(LawForm, GainOfTwoSides) {
  const EffectInstance e = Make("gain-of-two-sides", "B.x").at(0);
  const double up = At(e, "reading.x", {{"x", 1e-5}}) / 1e-5 - 1,
               down = At(e, "reading.x", {{"x", -1e-5}}) / -1e-5 - 1;
  EXPECT_NEAR(std::abs(up), 0.04, 1e-6);
  EXPECT_GE(down / up, 0.5 - 1e-5);
  EXPECT_LE(down / up, 0.8 + 1e-5);
}

// Each axis turns by its own angle: 0.04 rad, and six to eight and a half tenths of it.
// Of a whole bearing every coil's voltage follows the coil's own current: as the logarithm far
// above the knee.
TEST_P(LawForm, OffsetOfEveryCoilsOwnCurrent) {
  const std::vector<EffectInstance> all = Make("offset-of-current", "A");
  ASSERT_EQ(all.size(), 8u);
  for (std::size_t j = 0; j < all.size(); ++j) {
    EXPECT_EQ(all[j].target, "A.coil" + std::to_string(j + 1));
    const auto at = [&](double i) { return At(all[j], "voltage", {{"i", i}}); };
    EXPECT_NEAR(std::abs(at(0)), 0.5, 1e-12);
    EXPECT_GT(std::abs(at(2)), std::abs(at(1)));
    EXPECT_EQ(at(2), at(-2));
    EXPECT_NEAR((at(4e4) - at(2e4)) / (at(2e4) - at(1e4)), 1, 1e-3);
  }
  EXPECT_EQ(Make("offset-of-current", "A.coil3").size(), 1u);
}

TEST_P(LawForm, AxesThatAreNotSquare) {
  const EffectInstance e = Make("axes-skew", "A").at(0);
  const double a = std::atan2(At(e, "reading.x", {{"y", 1}}), At(e, "reading.x", {{"x", 1}})),
               b = -std::atan2(At(e, "reading.y", {{"x", 1}}), At(e, "reading.y", {{"y", 1}}));
  EXPECT_NEAR(std::abs(a), 0.04, 1e-6);
  EXPECT_GE(b / a, 0.6 - 1e-5);
  EXPECT_LE(b / a, 0.85 + 1e-5);
}

TEST_P(LawForm, ZeroThatDriftsAndDent) {
  const EffectInstance zero = Make("zero-drifting", "A.x").at(0);
  const double start = At(zero, "reading.x", {{"x", 1e-5}}) - 1e-5,
               later = At(zero, "reading.x", {{"t", 1}});
  EXPECT_NEAR(std::abs(start), 0.05 * kReach, 1e-12);
  EXPECT_GE(later / start, 1.1 - 1e-5);
  EXPECT_LE(later / start, 1.4 + 1e-5);
  // The dent is deepest under a probe, and a quarter of a turn later under the other one.
  const EffectInstance dent = Make("runout-dent", "A").at(0);
  double deepest = 0, at = 0, mean = 0;
  for (int k = 0; k < 720; ++k) {
    const double theta = kTurn * k / 720, x = At(dent, "reading.x", {{"theta", theta}});
    if (x < deepest) deepest = x, at = theta;
    mean += x / 720;
  }
  EXPECT_NEAR(mean, 0, 1e-6 * kReach);  // it would be a zero of the sensor
  EXPECT_GT(deepest, -0.04 * kReach);
  EXPECT_LT(deepest, -0.01 * kReach);
  EXPECT_NEAR(At(dent, "reading.y", {{"theta", at + M_PI / 2}}), deepest, 1e-6 * kReach);
}

// The operators share 5 %; widths fall by one factor from each to the next, or there are two of
// them.
TEST_P(LawForm, LoopsOfManyWidthsOrTwo) {
  const auto shares = [&](const EffectInstance& e) {
    std::vector<double> out;
    for (int k = 1; k <= kPlayOperators; ++k) out.push_back(e.Value("c" + std::to_string(k)));
    return out;
  };
  const auto many = shares(Make("hysteresis-narrow", "A").at(0));
  double sum = 0;
  for (const double c : many) sum += c;
  EXPECT_NEAR(sum, 0.05, 1e-9);
  for (std::size_t k = 1; k < many.size(); ++k) {
    EXPECT_NEAR(many[k] / many[k - 1], many[1] / many[0], 1e-9);
    EXPECT_GE(many[k] / many[k - 1], std::exp(-1.0) - 1e-9);
    EXPECT_LE(many[k] / many[k - 1], std::exp(-0.3) + 1e-9);
  }
  const auto two = shares(Make("hysteresis-two-widths", "A", 2).at(0));
  int used = 0;
  sum = 0;
  for (const double c : two) {
    used += c > 0 ? 1 : 0;
    sum += c;
  }
  EXPECT_EQ(used, 2);
  EXPECT_NEAR(sum, 0.1, 1e-9);
}

// Nodes of the iron's table are evenly spread to 1.5 T; a power of B is a straight line of
// logarithms, up to the longest path.
TEST_P(LawForm, IronOfAPowerAndOfRayleigh) {
  const EffectInstance power = Make("saturation-power", "A").at(0);
  EXPECT_EQ(power.Value("reach"), 1.5);
  const auto path = [](const EffectInstance& e, int k) {
    return e.Value("path" + std::to_string(k));
  };
  EXPECT_EQ(path(power, 0), 0);
  const double order = std::log2(path(power, 2) / path(power, 1));
  EXPECT_GE(order, 4 - 1e-6);
  EXPECT_LE(order, 9 + 1e-6);
  for (int k = 3; k < kBhNodes; ++k)
    EXPECT_NEAR(path(power, k), std::min(2e-3, path(power, 1) * std::pow(k, order)),
                1e-6 * path(power, k));
  const EffectInstance rayleigh = Make("reluctance-rayleigh", "A", 1.5).at(0);
  const double step = 1.5 / (kBhNodes - 1), a = (std::sqrt(4.5e-5 / path(rayleigh, 1)) - 1) / step;
  EXPECT_GE(a, 0.5 - 1e-6);
  EXPECT_LE(a, 4 + 1e-6);
  for (int k = 0; k < kBhNodes; ++k)
    EXPECT_NEAR(path(rayleigh, k), 4.5e-5 / std::pow(1 + a * step * k, 2), 1e-12);
}

// Brauer's H = k1 exp(k2 B²) B has dH/dB in proportion to (1 + 2 c x²) exp(c x²), x = B/knee: c
// from the first node, the knee from the second one, the third follows.
TEST_P(LawForm, IronOfBrauersExponential) {
  const EffectInstance iron = Make("saturation-brauer", "A").at(0);
  const double first = iron.Value("path0"), c = -std::log(first / 1e-5);
  EXPECT_GE(c, 1.5 - 1e-6);
  EXPECT_LE(c, 4 + 1e-6);
  const auto slope = [c](double x2) { return (1 + 2 * c * x2) * std::exp(c * x2); };
  double lo = 0, hi = 9;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (lo + hi);
    (slope(middle) * first < iron.Value("path1") ? lo : hi) = middle;
  }
  EXPECT_NEAR(iron.Value("path2"), std::min(2e-3, slope(4 * lo) * first),
              1e-6 * iron.Value("path2"));
}

INSTANTIATE_TEST_SUITE_P(Draws, LawForm, ::testing::Values(1, 2, 3, 4));

}  // namespace
}  // namespace ambrig
