// Waterfall and order tracks as they stand in the page: a run-up whose orders are known.
#include "app/figures/speed_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/math/constants.h"

namespace ambrig {
namespace {

using Json = nlohmann::json;
using Complex = std::complex<double>;

constexpr double kRate = 2000, kEnd = 8;                           // [Hz], [s]
constexpr double kOrder2 = 5e-6, kBackward = 3e-6, kLevel = 4e-6;  // [m]
constexpr double kLevelHz = 35;                                    // forward, whatever the speed

double SpeedAt(double t) { return 10 + 50 * t / kEnd; }  // [Hz]
double TurnsAt(double t) { return 10 * t + 25 * t * t / kEnd; }
double Order1At(double f) {
  return 2e-5 / (1 + std::pow((f - 40) / 8, 2));
}  // a critical speed at 40 Hz

RunReportData RunUp() {
  RunReportData d;
  d.name = "run-up";
  d.rate = kRate;
  d.start = 0.5;  // the page's time is the record's
  d.bearings.emplace_back();
  d.bearings[0].name = "A";
  d.bearings[0].clearance = 1e-4;
  d.stations.emplace_back();
  d.stations[0].name = "disk";
  for (int k = 0; k < kRate * kEnd; ++k) {
    const double t = k / kRate, theta = 2 * kPi * TurnsAt(t);
    const Complex z = std::polar(Order1At(SpeedAt(t)), theta + 0.3) +
                      std::polar(kOrder2, 2 * theta) + std::polar(kBackward, -theta) +
                      std::polar(kLevel, 2 * kPi * kLevelHz * t) + Complex(1e-5, -2e-5);
    d.theta.push_back(theta);
    d.bearings[0].x.push_back(z.real());
    d.bearings[0].y.push_back(z.imag());
    d.stations[0].x.push_back(2 * z.real());
    d.stations[0].y.push_back(2 * z.imag());
  }
  return d;
}

/// The figures in the page, as its script reads them.
std::vector<Json> FiguresOf(const std::string& html) {
  const std::string begin = "<script type=\"application/json\">", end = "</script>";
  std::vector<Json> out;
  for (std::size_t at = html.find(begin); at != std::string::npos; at = html.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    out.push_back(Json::parse(html.substr(from, html.find(end, from) - from)));
  }
  return out;
}

class SpeedFigures : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (const Json& figure : FiguresOf(MakeRunReport(RunUp()).Html()))
      for (const Json& trace : figure["data"]) {
        if (trace.value("type", "") == "heatmap") waterfall_ = figure;
        if (trace.value("name", "") == "order 1, forward") orders_ = figure;
      }
  }
  static Json waterfall_, orders_;
};
Json SpeedFigures::waterfall_, SpeedFigures::orders_;

/// The trace of a panel ("y", "y2") by its name.
const Json& Trace(const Json& figure, const std::string& name, const std::string& axis) {
  for (const Json& t : figure["data"])
    if (t.value("name", "") == name && t.value("yaxis", "") == axis) return t;
  throw std::runtime_error(name + " on " + axis);
}

std::size_t Nearest(const std::vector<double>& x, double to) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < x.size(); ++k)
    if (std::abs(x[k] - to) < std::abs(x[best] - to)) best = k;
  return best;
}

TEST_F(SpeedFigures, OrderTracksHaveTheirAmplitudesOverTheSpeed) {
  ASSERT_FALSE(orders_.is_null());
  const char* axes[] = {"y", "y2"};
  for (int panel = 0; panel < 2; ++panel) {
    const double times = panel + 1;  // the disk moves twice as far
    const auto amplitude = [&](const char* name, double hz) {
      const Json& t = Trace(orders_, name, axes[panel]);
      const auto rpm = t["x"].get<std::vector<double>>();
      return t["y"][Nearest(rpm, 60 * hz)].get<double>();
    };
    for (double hz : {20.0, 25.0, 45.0, 50.0, 55.0}) {  // away from the level line at 35 Hz
      EXPECT_NEAR(amplitude("order 1, forward", hz), times * 1e6 * Order1At(hz), times * 0.4) << hz;
      EXPECT_NEAR(amplitude("order 2, forward", hz), times * 5, times * 0.1) << hz;
      EXPECT_NEAR(amplitude("order 1, backward", hz), times * 3, times * 0.1) << hz;
    }
    // The largest of order 1 is the critical speed, 40 Hz = 2400 rpm.
    const Json& first = Trace(orders_, "order 1, forward", axes[panel]);
    std::size_t top = 0;
    for (std::size_t k = 0; k < first["y"].size(); ++k)
      if (first["y"][k].is_number() &&
          (!first["y"][top].is_number() || first["y"][k] > first["y"][top]))
        top = k;
    EXPECT_NEAR(first["x"][top].get<double>(), 2400, 40);
    EXPECT_NEAR(first["y"][top].get<double>(), times * 20, times * 0.6);
  }
}

TEST_F(SpeedFigures, WaterfallShowsOrdersAndLevelLinesOnTheirSides) {
  ASSERT_FALSE(waterfall_.is_null());
  const Json* map = nullptr;
  for (const Json& t : waterfall_["data"])
    if (t.value("type", "") == "heatmap" && t["yaxis"] == "y") map = &t;
  ASSERT_NE(map, nullptr);
  const auto time = (*map)["x"].get<std::vector<double>>(),
             frequency = (*map)["y"].get<std::vector<double>>();
  const double line = frequency[1] - frequency[0];
  EXPECT_LE(line, 4);
  for (double hz : {25.0, 50.0}) {
    const std::size_t column = Nearest(time, 0.5 + (hz - 10) * kEnd / 50);
    const auto level = [&](double f) {  // on the lines beside f
      double top = -1e9;
      for (std::size_t k = 0; k < frequency.size(); ++k)
        if (std::abs(frequency[k] - f) <= 0.6 * line)
          top = std::max(top, (*map)["z"][k][column].get<double>());
      return top;
    };
    // The speed changes by 3 Hz within a window, twice as much for order 2.
    EXPECT_NEAR(level(hz), 20 * std::log10(1e6 * Order1At(hz)), 1) << hz;
    EXPECT_NEAR(level(-hz), 20 * std::log10(3), 1) << hz;
    EXPECT_NEAR(level(2 * hz), 20 * std::log10(5), 1.5) << hz;
    EXPECT_NEAR(level(kLevelHz), 20 * std::log10(4), 0.3) << hz;
    EXPECT_LT(level(-kLevelHz), 20 * std::log10(4) - 20) << hz;  // forward only
    EXPECT_LT(level(0), -10) << hz;                              // the offset is out
    // The strongest line is order 1 at this speed (at 25 Hz it is 4.4 um, of order 2's size).
    if (hz < 40) continue;
    std::size_t top = 0;
    for (std::size_t k = 0; k < frequency.size(); ++k)
      if ((*map)["z"][k][column] > (*map)["z"][top][column]) top = k;
    EXPECT_NEAR(frequency[top], hz, line) << hz;
  }
}

TEST_F(SpeedFigures, TheSpeedIsDrawnOverTheMap) {
  const Json& speed = Trace(waterfall_, "speed", "y");
  const auto t = speed["x"].get<std::vector<double>>(), f = speed["y"].get<std::vector<double>>();
  for (double at : {1.0, 4.0, 8.0}) EXPECT_NEAR(f[Nearest(t, at)], SpeedAt(at - 0.5), 0.1);
}

TEST_F(SpeedFigures, AxesHaveTheirQuantityAndUnit) {
  const auto title = [](const Json& figure, const char* axis) {
    return figure["layout"][axis]["title"]["text"].get<std::string>();
  };
  EXPECT_EQ(title(waterfall_, "yaxis"), "frequency [Hz]");
  EXPECT_EQ(title(waterfall_, "yaxis2"), "frequency [Hz]");
  EXPECT_EQ(title(orders_, "yaxis"), "amplitude [µm]");
  // Panels one below the other share the lowest one's axis.
  EXPECT_EQ(title(waterfall_, "xaxis2"), "time [s]");
  EXPECT_EQ(title(orders_, "xaxis2"), "speed [rpm]");
  for (const Json& t : waterfall_["data"])
    if (t.value("type", "") == "heatmap" && t.value("showscale", true)) {
      EXPECT_EQ(t["colorbar"]["title"]["text"], "dB re 1 µm");
    }
  for (const Json& figure : {waterfall_, orders_}) {
    std::string titles;
    for (const Json& a : figure["layout"]["annotations"])
      titles += a["text"].get<std::string>() + ";";
    EXPECT_NE(titles.find("bearing A"), std::string::npos);
    EXPECT_NE(titles.find("disk"), std::string::npos);
  }
}

// A constant speed has neither figure.
TEST(SpeedFiguresAbsent, AtConstantSpeed) {
  RunReportData d = RunUp();
  for (std::size_t k = 0; k < d.theta.size(); ++k)
    d.theta[k] = 2 * kPi * 30 * static_cast<double>(k) / kRate;
  EXPECT_FALSE(SpeedVaries(d));
  EXPECT_EQ(MakeRunReport(d).Html().find("Waterfall"), std::string::npos);
}

}  // namespace
}  // namespace ambrig
