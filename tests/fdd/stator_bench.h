#pragma once
/// The simulator's own stator of one bearing, driven by given duties: what detectors are tested on.
#include "actuators/electronics/coil_voltage.h"
#include "actuators/magnetics/radial_stator.h"
#include "actuators/magnetics/stator_lanes.h"
#include "core/math/noise.h"
#include "fdd/detectors/coil_detector.h"

namespace ambrig::testing_bench {

inline constexpr double kT = 40e-6;
inline constexpr int kSamples = 18;

inline RadialStatorParameters Reference() {
  RadialStatorParameters p;
  p.turns = 50;
  p.pole_area = 2.0372e-4;
  p.gap = 4e-4;
  p.leakage_inductance = 3.5e-4;
  p.resistance = 0.5;
  return p;
}

inline AmplifierParameters Bridge() {
  AmplifierParameters a;
  a.bus_voltage = 30;
  a.switch_drop = 0.125;
  a.diode_drop = 0.7;
  a.switching_frequency = 1 / kT;
  a.kp = 4;
  a.ki = 2000;
  a.i_max = 6;
  return a;
}

/// True stator with one duty per coil; coil `open` broken.
struct Bench {
  StatorLanes lanes;
  AmplifierParameters amplifier = Bridge();
  Lane duty, adc[kSamples];
  double x0 = 1e-4, y0 = -0.5e-4, vx = 0, vy = 0, t = 0;
  double noise = 0;  // of the ADC [A rms]
  std::uint64_t seed = 1;

  Bench() {
    const LinkageModel m = MakeLinkageModel(Reference());
    lanes.n = m.n;
    lanes.leakage = m.leakage;
    lanes.resistance = m.resistance;
    lanes.direction_x = m.direction_x;
    lanes.direction_y = m.direction_y;
    lanes.gap_offset = m.gap_offset;
    lanes.reluctance = m.reluctance;
    lanes.SetStep(kT / kSamples);
    Lane two;
    for (double& i : two.v) i = 2;
    lanes.Settle(two, x0, y0);
    for (double& d : duty.v) d = 0.515;
  }
  MeasuredPeriod Run() {
    VoltagePattern pattern;
    for (int j = 0; j < kLanes; ++j) {
      const CoilVoltage v = IdealBridgeVoltage(amplifier, duty[j]);
      pattern.t1[j] = v.t1;
      pattern.t2[j] = v.t2;
      for (int q = 0; q < 3; ++q) {
        pattern.gain[q][j] = v.gain[q];
        pattern.drop[q][j] = v.drop[q];
      }
    }
    MeasuredPeriod in;
    in.t = t;
    in.x0 = x0;
    in.y0 = y0;
    in.x1 = x0 += vx * kT;
    in.y1 = y0 += vy * kT;
    lanes.RunPeriod(pattern, amplifier.bus_voltage, in.x0, in.y0, in.x1, in.y1, kSamples);
    float normal[kSamples * kLanes] = {};
    if (noise > 0) FillNormals(seed, 7, ++periods, normal, kSamples * kLanes);
    for (int k = 0; k < kSamples; ++k)
      for (int j = 0; j < kLanes; ++j)
        adc[k][j] = lanes.samples[k][j] + noise * static_cast<double>(normal[k * kLanes + j]);
    in.adc = adc;
    in.duty = &duty;
    in.bus = amplifier.bus_voltage;
    t += kT;
    return in;
  }
  std::uint64_t periods = 0;
  SamplingSettings Sampling() const { return {kSamples, kT / kSamples, &amplifier}; }
};

/// A radial bearing as the detectors know it; `bench` must outlive it.
inline CoilDetectorSetup SetupOf(const Bench& bench) {
  CoilDetectorSetup setup;
  setup.model = MakeLinkageModel(Reference());
  setup.settings.sampling = bench.Sampling();
  return setup;
}

}  // namespace ambrig::testing_bench
