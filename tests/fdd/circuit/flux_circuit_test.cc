#include "fdd/circuit/flux_circuit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

// One coil alone on a core: psi = i/rho, so that a tone of the current gives a tone of the flux of
// amplitude 1/|rho + sum r_m jw/(jw + p_m)|.
LinkageModel Alone() {
  LinkageModel m = MakeLinkageModel(Reference());
  m.coupling = Coupling::kNone;
  m.coils = 1;
  for (int j = 1; j < kLanes; ++j) m.n[j] = m.gap_offset[j] = 0;
  return m;
}

/// Its first period under a current that stands still, the bridge off.
FluxPeriod FirstPeriod(const FluxCircuit& circuit, double current) {
  const AmplifierParameters amplifier = Bridge();
  FluxFilter filter(Alone(), {kSamples, kT / kSamples, &amplifier}, circuit);
  Lane adc[kSamples], duty;
  for (Lane& i : adc) i[0] = current;
  MeasuredPeriod in;
  in.adc = adc;
  in.duty = &duty;
  in.bus = 30;
  FluxPeriod period;
  filter.Period(in, &period);
  return period;
}

double AmplitudeOf(const FluxCircuit& circuit, double frequency) {
  const AmplifierParameters amplifier = Bridge();
  FluxFilter filter(Alone(), {kSamples, kT / kSamples, &amplifier}, circuit);
  Lane adc[kSamples], duty;
  MeasuredPeriod in;
  in.adc = adc;
  in.duty = &duty;
  in.bus = 30;
  FluxPeriod period;
  double largest = 0;
  for (int n = 0; n < 2500; ++n) {
    for (int k = 0; k < kSamples; ++k)
      adc[k][0] = std::sin(2 * M_PI * frequency * (n * kT + k * kT / kSamples));
    filter.Period(in, &period);
    if (n > 1250) largest = std::max(largest, std::abs(period.flux[0]));
  }
  return largest;
}

TEST(FluxCircuit, RelaxationsHaveTheFrequencyResponseOfTheirSum) {
  FluxCircuit circuit;
  circuit.relaxation = {0.5, 0.8, 2, 5};
  for (const double f : {37.0, 300.0, 2000.0}) {
    std::complex<double> rho = 1;
    const std::complex<double> jw(0, f);
    for (std::size_t m = 0; m < kRelaxations; ++m)
      rho += circuit.relaxation[m] * jw / (jw + kRelaxationPoles[m]);
    // One sample of a period is looked at: its largest is within the tone's curvature of the peak.
    EXPECT_NEAR(AmplitudeOf(circuit, f), 1 / std::abs(rho), 4e-3) << f;
  }
}

// What a bridge that is off says of a coil whose reading may be a sensor's zero is not judged: its
// diodes may block.
TEST(FluxCircuit, LooksAtOffPhasesOfCoilsThatSurelyConductOnly) {
  const auto off_samples = [](double current) {
    return FirstPeriod({}, current).phase[1].samples[0];
  };
  EXPECT_GT(off_samples(0.3), 5);
  EXPECT_EQ(off_samples(0.2), 0);
}

TEST(FluxCircuit, FollowsTheSimulatorsFluxes) {
  Bench bench;
  bench.vx = 0.1;
  for (int j = 0; j < kLanes; ++j) bench.duty[j] = 0.5 + 0.01 * j;
  FluxFilter filter(MakeLinkageModel(Reference()), bench.Sampling(), {});
  FluxPeriod period;
  const double turns = Reference().turns;
  for (int n = 0; n < 20; ++n) {
    filter.Period(bench.Run(), &period);
    // The simulator's fluxes are those of the period's end, the filter's of its last sample.
    for (int j = 0; j < kLanes; ++j) {
      const double own = (Reference().gap / (kMu0 * Reference().pole_area)) / turns;
      EXPECT_NEAR(period.flux[j], bench.lanes.phi[j] * own, 0.05) << n << " " << j;
    }
  }
}

TEST(FluxCircuit, KneeMeetsItsOwnEquationAtRest) {
  FluxCircuit circuit;
  circuit.knee7 = 0.3;
  const double psi = FirstPeriod(circuit, 4).flux[0];
  EXPECT_NEAR(psi + 0.3 * std::pow(psi, 7) / 729, 4, 1e-9);
}

}  // namespace
}  // namespace ambrig
