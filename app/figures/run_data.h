#pragma once
/// What the report of a run shows, as plain data: a caller that has a record and its events fills
/// it. Everything SI; empty parts are left out of the report.
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "app/text/verdict.h"

namespace ambrig {

struct ReportEvent {
  double t = 0;  // [s]
  // fault detected classified redistributed not_redistributed alarm_cleared touchdown lift_off drop
  std::string kind;
  std::string target;  // "A3"
  std::string text;    // for the timeline: "open coil", "partial short, 48 % of the turns"
};

struct ReportBearing {
  std::string name;                           // "A"
  double clearance = 0;                       // of its auxiliary bearing [m]
  std::vector<double> pole_angles;            // γ_j [rad]
  std::vector<double> x, y;                   // at the record's times [m]
  std::vector<std::vector<double>> currents;  // (coil)(row) [A]
};

/// True motion of a named plane of a beam rotor, from its place at the start on.
struct ReportStation {
  std::string name;          // "disk"
  std::vector<double> x, y;  // at the record's times [m]
};

struct ReportChannel {
  std::string name, unit;  // "speed", "rpm"
  std::vector<double> samples;
};

/// One value per PWM period round the fault; NaN where the detector had no slope.
struct ReportSlope {
  std::string coil;               // "A3"
  std::vector<double> t;          // [s]
  std::vector<double> slope;      // measured, of the rising phase [A/s]
  std::vector<double> low, high;  // expected band [A/s]
  std::vector<double> flag;       // 1 once the detector says fault; may be empty
};

/// ADC samples of one coil during a few PWM periods: the paper's figures 13 and 18.
struct ReportSamples {
  std::string coil, stage;   // "A3", "normal stage"
  std::vector<double> t, i;  // [s], [A]
};

struct ReportSnapshot {
  std::string bearing, label;   // "A", "before the fault"
  double t = 0;                 // [s]
  std::vector<double> flux;     // per pole, into the rotor [Wb]
  std::vector<double> current;  // per coil [A]
  std::vector<int> failed;      // 1-based
  double x = 0, y = 0;          // shaft centre [m]
};

struct ReportExpect {
  std::string key, wanted, got;
  bool met = false;
};

struct RunReportData {
  std::string name, description;  // of the scenario
  std::string subtitle;           // fidelity, seed, version, date: one line
  enum Verdict verdict = Verdict::kInfo;
  std::string verdict_text;                                  // one sentence
  std::vector<std::string> notes;                            // what a reader must know besides
  std::vector<std::pair<std::string, std::string>> metrics;  // formatted (FormatSi)
  std::vector<ReportExpect> expect;
  std::vector<ReportEvent> events;

  double rate = 0, start = 0;  // time base of bearings and channels [Hz], [s]
  std::vector<ReportBearing> bearings;
  std::vector<ReportStation> stations;
  std::vector<double> theta;            // shaft angle at the record's times, unwrapped [rad]
  std::vector<ReportChannel> channels;  // speed, z, bus, ...

  std::vector<ReportSlope> slopes;  // the faulty coils first
  std::vector<ReportSamples> samples;
  std::vector<ReportSnapshot> snapshots;
  std::string scenario_toml, rig_toml;  // as they were read; shown folded
};

}  // namespace ambrig
