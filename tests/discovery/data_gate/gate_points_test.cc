// Mistakes in frequency responses and static tables are named; what effects do to them is not.
#include "discovery/data_gate/gate_points.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/math/constants.h"
#include "discovery/model/response_predictor.h"
#include "discovery/model/static_predictor.h"
#include "effects/catalogue.h"
#include "tests/discovery/bench_case.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;
using testing::CaseOf;
using testing::FaultsOf;
using testing::TemporaryFolder;
using testing::WriteBytes;

constexpr const char* kRecord =
    "[[record]]\ndata = \"a.csv\"\nkind = \"frf\"\nsd = 0.01\n[record.responses]\n"
    "\"A.x/A.x.force\" = { trace = \"c\", unit = \"um/N\" }\n"
    "\"A.x/A.x.command\" = { trace = \"p\", unit = \"um/N\" }\n";

/// A point as it is written: frequency [Hz], and the response of `trace` [um/N].
struct Point {
  double f;
  Complex value;
};
using Write = std::function<Point(char trace, double f, Complex value)>;

std::vector<double> Frequencies() {
  std::vector<double> out;
  for (int k = 0; k < 60; ++k) out.push_back(10 * std::pow(150.0, k / 59.0));  // to 1500 Hz
  return out;
}

std::string FileOf(const std::vector<double>& f, const std::vector<std::vector<Complex>>& H,
                   const Write& write, double sd) {
  std::mt19937 draw(7);
  std::normal_distribution<double> noise(0, sd);
  std::string text = "f [Hz],Re(c),Im(c),Re(p),Im(p)\n";
  for (std::size_t k = 0; k < f.size(); ++k) {
    double at = f[k];
    std::string values;
    for (std::size_t n = 0; n < 2; ++n) {
      const Complex h = 1e6 * H[n][k] * (1.0 + Complex(noise(draw), noise(draw)));
      const Point p = write(n == 0 ? 'c' : 'p', f[k], h);
      at = p.f;
      values += fmt::format(",{:.9g},{:.9g}", p.value.real(), p.value.imag());
    }
    text += fmt::format("{:.9g}{}\n", at, values);
  }
  return text;
}

/// Faults told of the responses of the spindle with these effects, as `write` writes them.
std::vector<DataFault> FaultsOfResponses(const Write& write,
                                         const std::vector<EffectInstance>& effects = {},
                                         double sd = 0.01) {
  const TemporaryFolder folder;
  const std::vector<double> f = Frequencies();
  const std::vector<std::vector<Complex>> ones(2, std::vector<Complex>(f.size(), 1));
  const Write as_is = [](char, double at, Complex v) { return Point{at, v}; };
  WriteBytes(folder.File("a.csv"), FileOf(f, ones, as_is, 0));
  const Case blank = CaseOf(folder, kRecord);
  RigParameters rig = blank.rig;
  rig.effects = effects;
  auto H = ResponsePredictor(blank, blank.records[0]).Respond(rig);
  EXPECT_EQ(H.size(), 2U);
  const auto& named = blank.records[0].responses.responses;
  if (named[0].name() != "A.x/A.x.force") std::swap(H[0], H[1]);
  WriteBytes(folder.File("a.csv"), FileOf(f, H, write, sd));
  return FaultsOf(CaseOf(folder, kRecord));
}

/// The change of the trace of the compliance alone.
Write OfCompliance(const std::function<Complex(double, Complex)>& change) {
  return [change](char trace, double f, Complex v) {
    return Point{f, trace == 'c' ? change(f, v) : v};
  };
}

void ExpectOfCompliance(const Write& write, const std::string& fault, double factor,
                        double seconds = 0, double sd = 0.01) {
  const auto faults = FaultsOfResponses(write, {}, sd);
  ASSERT_EQ(faults.size(), 1U) << fault << " " << factor;
  EXPECT_EQ(faults[0].fault, fault) << FaultText(faults[0]);
  EXPECT_EQ(faults[0].channel, "A.x/A.x.force");
  EXPECT_NEAR(faults[0].factor, factor, 0.01 * std::abs(factor));
  EXPECT_NEAR(faults[0].seconds, seconds, 2e-5);
  EXPECT_GT(faults[0].probability, 0.8);
}

TEST(GatePoints, SoundResponsesPass) {
  EXPECT_TRUE(FaultsOfResponses(OfCompliance([](double, Complex v) { return v; })).empty());
}

TEST(GatePoints, SignsAndConjugates) {
  ExpectOfCompliance(OfCompliance([](double, Complex v) { return -v; }), "sign", -1);
  ExpectOfCompliance(OfCompliance([](double, Complex v) { return std::conj(v); }), "sign", -1);
}

TEST(GatePoints, TheLineThatMendsASign) {
  const auto faults = FaultsOfResponses(OfCompliance([](double, Complex v) { return -v; }));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].mend,
            "responses.\"A.x/A.x.force\" = { trace = \"c\", unit = \"um/N\", gain = -1 }");
}

TEST(GatePoints, FactorsOfResponses) {
  for (const double factor : {1e3, 1e-3, 9.80665, 1 / 25.4, 2.0, 0.37})
    ExpectOfCompliance(OfCompliance([=](double, Complex v) { return factor * v; }), "unit", factor);
}

// Degrees read as radians are 57 times as large, noise included.
TEST(GatePoints, PhasesInTheOtherUnit) {
  for (const double factor : {kPi / 180, 180 / kPi})
    ExpectOfCompliance(OfCompliance([=](double, Complex v) {
                         return std::polar(std::abs(v), factor * std::arg(v));
                       }),
                       "unit", factor, 0, factor > 1 ? 5e-4 : 0.01);
}

TEST(GatePoints, DecibelsOfAPower) {
  for (const double power : {0.5, 2.0})
    ExpectOfCompliance(OfCompliance([=](double, Complex v) {
                         return std::polar(std::pow(std::abs(v), power), std::arg(v));
                       }),
                       "unit", power);
}

TEST(GatePoints, DelaysOfAnInstrument) {
  for (const double late : {1e-3, -2e-3, 8e-3})
    ExpectOfCompliance(
        OfCompliance([=](double f, Complex v) { return v * std::polar(1.0, -2 * kPi * f * late); }),
        "lag", 1, late);
}

TEST(GatePoints, FrequenciesInAnotherUnit) {
  for (const double factor : {2 * kPi, 1 / (2 * kPi)}) {
    const auto faults = FaultsOfResponses([=](char, double f, Complex v) {
      return Point{factor * f, v};
    });
    ASSERT_EQ(faults.size(), 1U) << factor;
    EXPECT_EQ(faults[0].fault, "unit");
    EXPECT_EQ(faults[0].channel, "frequency");
    EXPECT_NEAR(faults[0].factor, factor, 1e-9);
  }
}

TEST(GatePoints, EffectsInResponsesPass) {
  for (const auto& [name, target, parameter, value] :
       {std::tuple{"loop-delay", "rig", "time", 2.4e-4},
        {"sensor-gain", "A.x", "gain", 1.5},
        {"sensor-lowpass", "A.x", "frequency", 400.0},
        {"side-pull", "A", "stiffness", 5e4},
        {"iron-reluctance", "A", "path", 1e-4},
        {"bending-mode", "rig", "frequency", 300.0}}) {
    EffectInstance e = MakeInstance(EffectNamed(name), target);
    e.Set(parameter, value);
    const auto faults = FaultsOfResponses(OfCompliance([](double, Complex v) { return v; }), {e});
    EXPECT_TRUE(faults.empty()) << name << ": " << FaultText(faults[0]);
  }
}

constexpr const char* kTable =
    "[[record]]\ndata = \"t.csv\"\nkind = \"static\"\nsd = { \"A.fx\" = 0.02, \"A.fy\" = 0.02 }\n";

/// Faults told of a table of forces over positions and two currents; `write` changes a row before it is written:
/// x [m], i1 [A], i3 [A], fx [N], fy [N].
std::vector<DataFault> FaultsOfTable(const std::function<void(std::vector<double>&)>& write) {
  const TemporaryFolder folder;
  std::vector<std::vector<double>> rows;
  for (const double x : {-5e-5, 0.0, 6e-5})
    for (const double i1 : {0.5, 1.0, 1.8})
      for (const double i3 : {0.3, 1.5}) rows.push_back({x, i1, i3, 0, 0});
  const auto file = [&](bool changed) {
    std::string text = "A.x [m],A.i1 [A],A.i3 [A],A.fx [N],A.fy [N]\n";
    for (std::vector<double> row : rows) {
      if (changed) write(row);
      text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", row[0], row[1], row[2], row[3],
                          row[4]);
    }
    WriteBytes(folder.File("t.csv"), text);
    return CaseOf(folder, kTable);
  };
  const Case blank = file(false);
  std::vector<std::vector<double>> columns;
  EXPECT_TRUE(StaticPredictor(blank, blank.records[0]).Predict(blank.rig, columns));
  std::mt19937 draw(9);
  std::normal_distribution<double> noise(0, 0.02);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t o = 0; o < 2; ++o)
      rows[k][3 + o] = columns[o][k] * blank.records[0].table.sd[o][k] + noise(draw);
  return FaultsOf(file(true));
}

void ExpectOfTable(const std::function<void(std::vector<double>&)>& write,
                   const std::vector<std::string>& columns, double factor) {
  const auto faults = FaultsOfTable(write);
  ASSERT_EQ(faults.size(), columns.size()) << columns[0] << " " << factor;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    EXPECT_EQ(faults[k].fault, factor < 0 ? "sign" : "unit") << FaultText(faults[k]);
    EXPECT_EQ(faults[k].channel, columns[k]);
    EXPECT_NEAR(faults[k].factor, factor, 0.02 * std::abs(factor));
    EXPECT_FALSE(faults[k].mend.empty());
  }
}

TEST(GatePoints, FactorsOfTables) {
  EXPECT_TRUE(FaultsOfTable([](std::vector<double>&) {}).empty());
  ExpectOfTable([](auto& row) { row[3] *= 1e-3; }, {"A.fx"}, 1e-3);
  ExpectOfTable([](auto& row) { row[4] *= -1; }, {"A.fy"}, -1);
  ExpectOfTable([](auto& row) { row[3] *= 2.3; }, {"A.fx"}, 2.3);
  // larger forces in both directions are the machine's
  EXPECT_TRUE(FaultsOfTable([](auto& row) { row[3] *= 1.7, row[4] *= 1.7; }).empty());
}

TEST(GatePoints, WhatWasSetInATable) {
  ExpectOfTable([](auto& row) { row[1] *= 1e-3, row[2] *= 1e-3; }, {"A.i1", "A.i3"}, 1e-3);
  ExpectOfTable([](auto& row) { row[0] *= -1; }, {"A.x"}, -1);
}

}  // namespace
}  // namespace ambrig
