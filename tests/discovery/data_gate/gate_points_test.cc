// Mistakes in frequency responses are named; what effects do to them is not.
#include "discovery/data_gate/gate_points.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/math/constants.h"
#include "discovery/model/response_predictor.h"
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

/// The record with a line that was pasted into its table, in place of what it says of the
/// compliance.
std::string WithLine(const std::string& line) {
  if (!line.starts_with("responses.")) {
    std::string record = kRecord;
    return record.insert(record.find("[record.responses]"), line + "\n");
  }
  std::string record = kRecord;
  const std::size_t at = record.find("\"A.x/A.x.force\"");
  return record.replace(at, record.find('\n', at) - at, line.substr(line.find('"')));
}

/// Faults told of the responses of the spindle with these effects, as `write` writes them; `line`:
/// pasted into the record.
std::vector<DataFault> FaultsOfResponses(const Write& write,
                                         const std::vector<EffectInstance>& effects = {},
                                         double sd = 0.01, const std::string& line = "") {
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
  return FaultsOf(CaseOf(folder, line.empty() ? kRecord : WithLine(line)));
}

/// The same where the plant's trace is of another axis.
std::vector<DataFault> FaultsOfOtherAxis(const std::string& axis) {
  const TemporaryFolder folder;
  std::string record = kRecord;
  record.replace(record.find("A.x/A.x.command"), 3, axis);
  const Write as_is = [](char, double at, Complex v) { return Point{at, v}; };
  const std::vector<double> f = Frequencies();
  WriteBytes(folder.File("a.csv"), FileOf(f, {2, std::vector<Complex>(f.size(), 1)}, as_is, 0));
  const Case blank = CaseOf(folder, record);
  auto H = ResponsePredictor(blank, blank.records[0]).Respond(blank.rig);
  EXPECT_EQ(H.size(), 2U);
  if (blank.records[0].responses.responses[0].name() != "A.x/A.x.force") std::swap(H[0], H[1]);
  WriteBytes(folder.File("a.csv"), FileOf(f, H, as_is, 0.01));
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

/// The faults of the compliance that are told, and those that are left once the first line is in
/// the case.
void ExpectMended(const Write& write, const std::string& line) {
  const auto faults = FaultsOfResponses(write);
  ASSERT_EQ(faults.size(), 1U) << line;
  EXPECT_NE(faults[0].mend.find(line), std::string::npos) << faults[0].mend;
  const auto left = FaultsOfResponses(write, {}, 0.01, faults[0].mend);
  EXPECT_TRUE(left.empty()) << FaultText(left[0]);
}

TEST(GatePoints, LinesThatMendPhases) {
  ExpectMended(OfCompliance([](double, Complex v) { return std::conj(v); }), "conjugate = true");
  ExpectMended(
      OfCompliance([](double f, Complex v) { return v * std::polar(1.0, -2 * kPi * f * 2e-3); }),
      "late = 0.00");
  ExpectMended(OfCompliance([](double, Complex v) {
                 return std::polar(std::abs(v), kPi / 180 * std::arg(v));
               }),
               "phase_gain = 57.2957795");
}

// The plant's trace holds what the other bearing's sensor showed, and the compliance is right.
TEST(GatePoints, ACableAtTheWrongInput) {
  const std::vector<DataFault> faults = FaultsOfOtherAxis("B.x");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "swap");
  EXPECT_EQ(faults[0].channel, "A.x/A.x.command");
  EXPECT_EQ(faults[0].with, "B.x/A.x.command");
  EXPECT_TRUE(faults[0].mend.starts_with("responses.\"B.x/A.x.command\" = { trace = \"p\""))
      << faults[0].mend;
}

TEST(GatePoints, TheLineThatMendsFrequencies) {
  ExpectMended(
      [](char, double f, Complex v) {
        return Point{2 * kPi * f, v};
      },
      "frequency_gain = 0.159154943");
}

// What a file has lost no key of a case brings back.
TEST(GatePoints, WhatNoKeyMendsIsToBeCorrectedInTheFile) {
  const auto faults = FaultsOfResponses(OfCompliance(
      [](double, Complex v) { return std::polar(std::sqrt(std::abs(v)), std::arg(v)); }));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(faults[0].mend.empty());
  EXPECT_NE(FaultText(faults[0]).find("no key of a case mends it: write its magnitudes"),
            std::string::npos)
      << FaultText(faults[0]);
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

// Over micrometres and over metres per newton, in a column of micrometres.
TEST(GatePoints, LevelsReadAsMagnitudes) {
  for (const double over : {1.0, 1e6})
    ExpectOfCompliance(OfCompliance([=](double, Complex v) {
                         return 20 * std::log10(std::abs(v) / over) * v / std::abs(v);
                       }),
                       "unit", 1);
}

TEST(GatePoints, StiffnessUnderTheNameOfACompliance) {
  for (const double unit : {1.0, 1e-12})
    ExpectOfCompliance(OfCompliance([=](double, Complex v) { return unit / v; }), "unit", 1);
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

}  // namespace
}  // namespace ambrig
