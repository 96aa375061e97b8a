// Coils of any stator against closed forms: two cores without a common path, a coil on each.
#include "fdd/detectors/linkage_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "fdd/circuit/inductance_matrix.h"
#include "fdd/detectors/linkage_phases.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// C-cores at both sides of the shaft: L = 2 N² mu0 A/g, so that a sample of 30 V moves 0.05 A.
/// Coil 0 may have lost turns or be without its amplifier; the bridges have no drops.
class TwoCores {
 public:
  explicit TwoCores(double resistance, double duty_of_both) {
    bridge_.switch_drop = bridge_.diode_drop = 0;
    std::vector<NetworkPole> poles(4);
    Eigen::MatrixXd turns = Eigen::MatrixXd::Zero(4, 2);
    for (int p = 0; p < 4; ++p) {
      NetworkPole& pole = poles[static_cast<std::size_t>(p)];
      pole.direction = {p < 2 ? 1.0 : -1.0, 0, 0};
      pole.area = 1e-4;
      pole.gap = 4.7e-4;
      pole.part = p / 2;
      turns(p, p / 2) = p % 2 ? -50 : 50;
    }
    model_.coupling = Coupling::kNetwork;
    model_.coils = 2;
    model_.network = std::make_shared<const PoleNetwork>(poles, turns);
    for (int j = 0; j < 2; ++j) {
      model_.resistance[j] = resistance;
      duty[j] = duty_of_both;
      current[j] = 1;
    }
  }
  static double Inductance() { return 2 * 50 * 50 * kMu0 * 1e-4 / 4.7e-4; }
  RunDetectorSetup Setup() const {
    RunDetectorSetup s;
    s.model = model_;
    s.settings.sampling = Sampling();
    return s;
  }
  SamplingSettings Sampling() const { return {kSamples, kT / kSamples, &bridge_}; }

  /// share² L di/dt = v - share R i by the trapezoidal rule between the samples.
  MeasuredPeriod Run() {
    MeasuredPeriod in;
    in.t = t_;
    in.adc = adc_;
    in.duty = &duty;
    in.set_point = &set_point;
    in.bus = bridge_.bus_voltage;
    const double h = kT / kSamples;
    for (int k = 0; k < kSamples; ++k)
      for (int j = 0; j < 2; ++j) {
        const double a = j == 0 ? share : 1, L = a * a * Inductance(),
                     drop = 0.5 * h * a * model_.resistance[j];
        adc_[k][j] = current[j];
        const double driven = j == 0 && off ? -h * in.bus : DrivenLinkage(Sampling(), in, j, k);
        current[j] = ((L - drop) * current[j] + driven) / (L + drop);
        if (j == 0 && off) current[j] = std::max(0.0, current[j]);  // its diodes block
      }
    t_ += kT;
    return in;
  }
  Lane duty, set_point, current;
  double share = 1;
  bool off = false;

 private:
  AmplifierParameters bridge_ = Bridge();
  LinkageModel model_;
  Lane adc_[kSamples];
  double t_ = 0;
};

/// The first diagnosis of the slopes within ten windows.
Diagnosis PhasesOf(TwoCores& cores) {
  LinkagePhases phases(cores.Setup().model, cores.Sampling(), 0.004);
  EXPECT_EQ(phases.window(), 3);
  Diagnosis found;
  for (int n = 0; n < 30 && found.cls == FaultClass::kNone; ++n)
    found = phases.Period(cores.Run(), {});
  return found;
}

// At 5 ohm and 1.8 A the copper takes 9 of 30 V. The linkage of a coil with the share a of its
// turns moves too much, up and down, by
//   c = (V - a R i)/(a² (V - R i)) - 1,   (V + a R i)/(a² (V + R i)) - 1:
// 0.97 and 0.67 without a quarter of them, whose mean stands for a share of 0.26.
TEST(LinkagePhases, AShortIsSeenBesideTheDropOfTheCopper) {
  TwoCores healthy(5, 0.5 + 0.5 * 9 / 30);
  healthy.current[0] = healthy.current[1] = 1.8;
  EXPECT_EQ(PhasesOf(healthy).cls, FaultClass::kNone);
  TwoCores cores(5, 0.5 + 0.5 * 0.75 * 9 / 30);
  cores.share = 0.75;
  cores.current[0] = 1.8;
  const Diagnosis found = PhasesOf(cores);
  EXPECT_EQ(found.coil, 0);
  EXPECT_EQ(found.cls, FaultClass::kPartialShort);
  const double up = 23.25 / (0.5625 * 21) - 1, down = 36.75 / (0.5625 * 39) - 1;
  EXPECT_NEAR(found.fraction, 1 - 1 / std::sqrt(1 + 0.5 * (up + down)), 0.01);
  EXPECT_NEAR(found.time, 6 * kT, 1e-12);  // two windows of three periods
  EXPECT_EQ(found.onset, 0);
}

/// What is found of coil 0 when it carries 1 A and its loop drives what it can after it got lost.
Diagnosis LossOfCoil0(bool at_once) {
  TwoCores cores(0.5, 0.5 + 0.5 * 0.5 / 30);
  cores.set_point[0] = cores.set_point[1] = 1;
  const auto detector = MakeLinkageBalance(cores.Setup());
  for (int n = 0; n < 20; ++n)
    EXPECT_EQ(detector->Period(cores.Run()).diagnosis.cls, FaultClass::kNone) << n;
  cores.off = true;
  if (at_once) cores.current[0] = 0;
  cores.duty[0] = 0.9;
  Diagnosis found;
  for (int n = 0; n < 8 && found.cls == FaultClass::kNone; ++n)
    found = detector->Period(cores.Run()).diagnosis;
  EXPECT_EQ(found.coil, 0);
  return found;
}

// A bridge that drives no more lets the current fall by V h/L = 0.05 A a sample, a broken wire by
// all of it.
TEST(LinkageBalance, ACurrentThatFallsAtItsOwnPaceIsNoBrokenWire) {
  EXPECT_NEAR(30 * kT / kSamples / TwoCores::Inductance(), 0.05, 1e-3);
  EXPECT_EQ(LossOfCoil0(false).cls, FaultClass::kAmplifierOff);
  EXPECT_EQ(LossOfCoil0(true).cls, FaultClass::kOpen);
}

}  // namespace
}  // namespace ambrig
