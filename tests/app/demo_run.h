#pragma once
/// A made-up run for the report's tests: not physics, only shaped like it. Coil A3 opens at 1.0 s,
/// is detected after 0.28 ms, currents are redistributed after 0.4 ms.
#include <cmath>
#include <numbers>
#include <string>

#include "app/pages/run_report.h"
#include "app/text/format.h"

namespace ambrig::demo {

inline constexpr double kFault = 1.0, kDetected = 1.00028, kRedistributed = 1.0004;
inline constexpr double kTwoPi = 2 * std::numbers::pi;

// Repeatable scatter in [-1, 1] without a generator.
inline double Scatter(std::size_t k) {
  return 2 * std::fmod(0.5 + 0.754877666 * static_cast<double>(k), 1.0) - 1;
}

inline ReportBearing Bearing(const std::string& name, double rate, std::size_t rows) {
  ReportBearing b;
  b.name = name;
  b.clearance = 150e-6;
  const bool faulty = name == "A";
  b.currents.resize(8);
  for (int j = 0; j < 8; ++j) b.pole_angles.push_back(kTwoPi * (0.0625 + j / 8.0));
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) / rate, after = t - kFault;
    const double jump =
        after > 0 && faulty ? 36e-6 * std::exp(-after / 0.02) * std::sin(90 * after * 3) : 0;
    b.x.push_back(9e-6 * std::cos(kTwoPi * 25 * t) + 0.3e-6 * Scatter(k) + 0.6 * jump);
    b.y.push_back(9e-6 * std::sin(kTwoPi * 25 * t) + 0.3e-6 * Scatter(k + 7) - jump);
    for (int j = 0; j < 8; ++j) {
      double i = 1.2 + 0.3 * std::cos(b.pole_angles[static_cast<std::size_t>(j)] - kTwoPi * 25 * t);
      if (faulty && j == 2 && after > 0) i = 0;
      if (faulty && j != 2 && t > kRedistributed)
        i += 0.25 * (j % 2 == 0 ? 1 : -1) * (1 - std::exp(-(t - kRedistributed) / 1e-3));
      b.currents[static_cast<std::size_t>(j)].push_back(
          i + 0.01 * Scatter(k + static_cast<std::size_t>(j)));
    }
  }
  return b;
}

inline ReportSlope Slope(int coil) {
  ReportSlope s;
  s.coil = "A" + std::to_string(coil);
  for (std::size_t k = 0; k < 400; ++k) {
    const double t = kFault - 8e-3 + 40e-6 * static_cast<double>(k);
    double middle = 16800 + 900 * std::sin(kTwoPi * 25 * t + coil);
    if (t > kFault) middle *= 1 + 0.15 * std::cos(coil);  // the healthy ones move too
    const bool open = coil == 3 && t >= kFault;
    s.t.push_back(t);
    s.low.push_back(middle - 600);
    s.high.push_back(middle + 600);
    s.slope.push_back(open ? 300 * Scatter(k) : middle + 350 * Scatter(k));
    s.flag.push_back(coil == 3 && t >= kDetected ? 1 : 0);
  }
  return s;
}

inline ReportSamples Samples(const std::string& stage, double t0, double mean, double slope) {
  ReportSamples s{"A3", stage, {}, {}};
  for (std::size_t k = 0; k < 72; ++k) {
    const double phase = std::fmod(static_cast<double>(k) / 18.0, 1.0);
    s.t.push_back(t0 + static_cast<double>(k) / 450e3);
    s.i.push_back(mean + slope * 40e-6 * (phase < 0.5 ? phase - 0.25 : 0.75 - phase) +
                  0.002 * Scatter(k));
  }
  return s;
}

inline ReportSnapshot Snapshot(const std::string& label, double t, bool failed, double x,
                               double y) {
  ReportSnapshot s{"A", label, t, {}, {}, {}, x, y};
  for (int j = 0; j < 8; ++j) {
    const double sense = j % 2 == 0 ? 1 : -1;
    const bool dead = failed && j == 2;
    s.flux.push_back(sense * (dead ? 12e-6 : 61e-6 * (1 + 0.2 * std::cos(j + x * 1e5))));
    s.current.push_back(dead ? 0 : 1.2 + 0.2 * std::cos(j));
  }
  if (failed) s.failed = {3};
  return s;
}

inline RunReportData Run() {
  RunReportData d;
  d.name = "coil_a3_opens_1500rpm";
  d.description = "Coil A3 breaks at **1500 rpm**; the rest of the stator must carry the rotor.";
  d.subtitle = "switching fidelity · seed 7 · made-up data of a test";
  d.verdict = Verdict::kOk;
  d.verdict_text =
      "The rotor stayed up: A3 open, detected after 0.28 ms, redistributed after 0.4 ms, no "
      "touchdown.";
  d.metrics = {{"largest orbit A", FormatSi(38.2e-6, "m")},
               {"largest orbit B", FormatSi(9.4e-6, "m")},
               {"clearance left", "75 %"},
               {"peak current", FormatSi(1.92, "A")},
               {"copper loss", FormatSi(14.1, "W")},
               {"detection delay", FormatSi(0.28e-3, "s")},
               {"false alarms", "0"},
               {"coil periods", FormatNumber(1e6)}};
  d.expect = {{"detected_within", "2 ms", "0.28 ms", true},
              {"max_orbit", "30 µm", "38.2 µm", false}};
  d.events = {{kFault, "fault", "A3", "open coil"},
              {kDetected, "detected", "A3", "slope outside its band in 7 of 10 periods"},
              {1.00032, "classified", "A3", "open"},
              {kRedistributed, "redistributed", "A", "exact W for the set {3}"}};
  d.rate = 25e3;
  const std::size_t rows = 40001;
  d.bearings = {Bearing("A", d.rate, rows), Bearing("B", d.rate, rows)};
  ReportChannel speed{"speed", "rpm", std::vector<double>(rows, 1500.0)}, bus{"bus", "V", {}};
  for (std::size_t k = 0; k < rows; ++k) bus.samples.push_back(30 + 0.3 * Scatter(k));
  d.channels = {speed, bus};
  for (const int coil : {3, 1, 2, 4, 5, 6, 7, 8}) d.slopes.push_back(Slope(coil));
  d.samples = {Samples("normal stage", 0.99, 1.1, 16800), Samples("fault stage", 1.0002, 0, 0),
               Samples("fault-tolerant stage", 1.01, 0, 0)};
  d.snapshots = {Snapshot("before the fault", 0.9999, false, 9e-6, 0),
                 Snapshot("faulty, not yet compensated", 1.0003, true, 14e-6, -20e-6),
                 Snapshot("fault-tolerant", 1.02, true, 3e-6, -36e-6)};
  d.scenario_toml = "name = \"coil_a3_opens_1500rpm\"\nrig = \"rigs/seed.toml\"  # a < b & c\n";
  return d;
}

}  // namespace ambrig::demo
