// The fit against coils that obey its own equations.
#include "fdd/learning/commissioning_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// One coil alone on a core whose iron bends at psi = 3 A:
///   psi + b (psi/3)^6 psi + a (psi/3)^14 psi = i,   M0 psi' + L i' = v - R i,
/// by small steps, under duties that carry it from 1 to 3.5 A and back.
class BentCoil {
 public:
  BentCoil(double b, double a) : b_(b), a_(a), log_(kSamples) {
    amplifier_.switch_drop = amplifier_.diode_drop = 0;
    model_ = MakeLinkageModel(Reference());
    model_.coupling = Coupling::kNone;
    model_.coils = 1;
    for (int j = 1; j < kLanes; ++j) model_.n[j] = model_.gap_offset[j] = 0;
    inductance_ = FluxFilter(model_, Sampling(), {}).inductances()[0];
    for (int n = 0; n < 480; ++n) Add(2.25 - 1.25 * std::cos(2 * M_PI * n / 400));
  }
  CommissionedBearing Fitted() const { return FitCommissioning("A", model_, Sampling(), {}, log_); }

 private:
  SamplingSettings Sampling() const { return {kSamples, kT / kSamples, &amplifier_}; }
  double Current() const {
    const double x2 = psi_ * psi_ / 9, x6 = x2 * x2 * x2;
    return psi_ * (1 + b_ * x6 + a_ * x6 * x6 * x2);
  }
  /// One period that follows `wanted` [A].
  void Add(double wanted) {
    Lane adc[kSamples], duty;
    duty[0] = std::clamp(0.5 + 0.02 * (wanted - Current()) + 0.5 * 0.5 * wanted / 30, 0.3, 0.7);
    constexpr int kSteps = 20;
    const double h = kT / kSamples / kSteps;
    for (int k = 0; k < kSamples; ++k) {
      adc[k][0] = Current();
      for (int step = 0; step < kSteps; ++step) {
        const double x2 = psi_ * psi_ / 9, x6 = x2 * x2 * x2,
                     slope = 1 + 7 * b_ * x6 + 15 * a_ * x6 * x6 * x2,
                     v = (k + (step + 0.5) / kSteps) / kSamples < duty[0] ? 30 : -30;
        psi_ +=
            h * (v - model_.resistance[0] * Current()) / (inductance_ + model_.leakage[0] * slope);
      }
    }
    MeasuredPeriod in;
    in.t = static_cast<double>(log_.size()) * kT;
    in.adc = adc;
    in.duty = &duty;
    in.bus = 30;
    log_.Add(in);
  }
  double b_, a_, inductance_ = 0, psi_ = 1;
  AmplifierParameters amplifier_ = Bridge();
  LinkageModel model_;
  CommissioningLog log_;
};

// What obeys the model's own equations leaves next to nothing of the residuals; one power of two
// would leave a third of their expected size, and a coil that does not bend needs none.
TEST(CommissioningFit, ExpressesIronThatBendsByBothPowers) {
  const CommissionedBearing bent = BentCoil(0.3, 0.2).Fitted();
  EXPECT_TRUE(bent.learnt);
  EXPECT_EQ(bent.rows, 120);  // of 60 blocks of eight periods, two phases each
  EXPECT_LT(bent.grade, 0.03);
  EXPECT_GT(bent.circuit.knee7, 0);
  EXPECT_GT(bent.circuit.knee15, 0);
  const CommissionedBearing straight = BentCoil(0, 0).Fitted();
  EXPECT_LT(straight.grade, 0.03);
  EXPECT_EQ(straight.circuit.knee7, 0);
  EXPECT_EQ(straight.circuit.knee15, 0);
}

// Iron of one power only: the columns of both powers are much alike, and a step along both leaves
// the wrong one.
TEST(CommissioningFit, ExpressesIronThatBendsByEitherPower) {
  for (const auto& [b, a] : {std::pair{0.4, 0.0}, {0.0, 0.1}, {0.0, 0.4}}) {
    const CommissionedBearing bent = BentCoil(b, a).Fitted();
    EXPECT_LT(bent.grade, 1.5) << b << " " << a;
    EXPECT_TRUE(bent.usable());
  }
}

}  // namespace
}  // namespace ambrig
