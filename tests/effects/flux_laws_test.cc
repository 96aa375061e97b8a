// Iron laws on their own: eddy currents, saturation, hysteresis.
#include <gtest/gtest.h>

#include <complex>
#include <fstream>
#include <sstream>

#include "effects/coil_targets.h"
#include "effects/diffusion_fit.h"
#include "effects/steel_curve.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

constexpr double kStep = 1 / 450e3;  // [s] the ADC's

double DropOf(const FluxLaw& law, double phi, double* slope = nullptr) {
  Lane drop, tangent;
  law.Drop(Currents(phi), &drop, &tangent);
  if (slope) *slope = tangent[0];
  return drop[0];
}

// published_values.md 7: tanh z / z at ω τ = 0.1, 1, 10, 100: magnitude and phase.
// ρ (z coth z - 1) + ρ is its inverse.
TEST(EddyCurrents, LaminationFollowsTheLadderValues) {
  const double table[4][3] = {
      {0.1, 0.99922, -1.909}, {1, 0.93080, -17.958}, {10, 0.31795, -46.271}, {100, 0.1, -45}};
  for (const auto& row : table) {
    // τ = 1/(ρ² ω_c): with ρ = 1 and cutoff 1/(2 pi), τ = 1 s.
    const Complex h = 1.0 / (1.0 + Diffusion(Complex(0, row[0]), 1 / (2 * kPi), 1));
    EXPECT_NEAR(std::abs(h), row[1], 1e-5);  // last digit of the table
    EXPECT_NEAR(std::arg(h) * 180 / kPi, row[2], 1e-3);
  }
}

TEST(EddyCurrents, RelaxationsFollowTheHalfOrder) {
  for (const double cutoff : {100.0, 4300.0, 1e5}) {
    const DiffusionFit fit = FitDiffusion(cutoff, 0);
    for (double f = 50; f < 2.01e5; f *= 1.05) {
      const Complex s(0, 2 * kPi * f), ratio = fit.At(s) / Diffusion(s, cutoff, 0);
      EXPECT_NEAR(std::abs(ratio), 1, 0.01) << f;
      EXPECT_NEAR(std::arg(ratio), 0, 0.01) << f;
    }
  }
}

TEST(EddyCurrents, RelaxationsFollowTheLamination) {
  for (const double rho : {0.01, 0.09, 0.3})
    for (const double cutoff : {300.0, 4300.0, 3e4}) {
      const DiffusionFit fit = FitDiffusion(cutoff, rho);
      for (double f = 50; f < 2.01e5; f *= 1.05) {
        // Against the whole reluctance, gap included: what flux and force see.
        const Complex s(0, 2 * kPi * f), wanted = 1.0 + Diffusion(s, cutoff, rho);
        EXPECT_LT(std::abs((1.0 + fit.At(s)) / wanted - 1.0), 0.03)
            << f << " " << cutoff << " " << rho;
      }
    }
}

// Driven by a sampled sine the law answers with T(jω): its steps are exact for a flux linear over a
// step. The chords of the sine are (ω h)²/12 smaller, and relaxations faster than a step see the
// chord's slope, which belongs to the middle of the step: they lag by ω h/2.
TEST(EddyCurrents, StepsReproduceTheFrequencyResponse) {
  Plant plant = PlantWith("eddy-currents", "A", {{"cutoff", 2000}});
  FluxLaw& law = *plant.bearings[0].laws.at(0);
  law.SetStep(kStep);
  law.Settle(Lane{});
  const double gap = GapReluctanceOf(plant.bearings[0]), f = 5000;
  const int per_cycle = 90, cycles = 400;
  Complex seen = 0;
  for (int k = 1; k <= per_cycle * cycles; ++k) {
    const double angle = 2 * kPi * k / per_cycle, phi = 1e-5 * std::sin(angle);
    const double drop = DropOf(law, phi);
    law.Commit(Currents(phi));
    if (k > per_cycle * (cycles - 1))
      seen += drop * Complex(std::sin(angle), std::cos(angle)) * (2.0 / per_cycle);
  }
  const DiffusionFit fit = FitDiffusion(2000, 0);
  const Complex s(0, 2 * kPi * f), wanted = gap * 1e-5 * fit.At(s);
  double fast = fit.tail * std::abs(s);
  for (int k = 0; k < kDiffusionPoles; ++k)
    if (fit.pole[k] * kStep > 0.3) fast += std::abs(fit.residue[k] * s / (s + fit.pole[k]));
  const double angle = std::abs(s) * kStep;
  EXPECT_LT(std::abs(seen / wanted - 1.0),
            angle * angle / 12 + 0.5 * angle * fast / std::abs(fit.At(s)));
  EXPECT_NEAR(std::arg(seen), kPi / 4, 0.02);
}

TEST(EddyCurrents, VanishAtRest) {
  Plant with = PlantWith("eddy-currents", "A", {{"cutoff", 500}}),
        without = BuildPlant(TrueRig(ReferenceRig()));
  EXPECT_EQ(RestFlux(with, Currents(2))[0], RestFlux(without, Currents(2))[0]);
  // After a jump the drop decays, at long times as 1/sqrt(pi ω_c t) gap reluctances.
  FluxLaw& law = *with.bearings[0].laws.at(0);
  law.SetStep(kStep);
  law.Settle(Lane{});
  const double gap = GapReluctanceOf(with.bearings[0]), t = 1e-3;
  for (int k = 0; k < std::lround(t / kStep); ++k) law.Commit(Currents(1e-5));
  EXPECT_NEAR(DropOf(law, 1e-5) / (gap * 1e-5), 1 / std::sqrt(kPi * 2 * kPi * 500 * t), 0.01);
}

// No conductor closes round the flux of a laminated stator: of two radial bearings and a thrust
// bearing it is the last.
TEST(EddySleeve, ActsOnYokesInOnePiece) {
  EXPECT_EQ(TargetsOf(EffectNamed("eddy-sleeve"), TargetsOfEffects(ReferenceRig())),
            std::vector<std::string>{"Z"});
}

// E = R_gap φ'/ω_c: in proportion to the rate of the flux, nothing at rest.
TEST(EddySleeve, DropIsTheRateOfTheFlux) {
  Plant plant = PlantWith("eddy-sleeve", "A", {{"cutoff", 400}});
  FluxLaw& law = *plant.bearings[0].laws.at(0);
  EXPECT_TRUE(law.linear());
  law.SetStep(kStep);
  law.Settle(Currents(3e-6));
  const double gap = GapReluctanceOf(plant.bearings[0]), T = 1 / (2 * kPi * 400);
  double slope = 0;
  EXPECT_EQ(DropOf(law, 3e-6, &slope), 0);
  EXPECT_NEAR(slope, gap * T / kStep, 1e-12 * slope);
  EXPECT_NEAR(DropOf(law, 5e-6), gap * T * 2e-6 / kStep, 1e-9 * gap * T * 2e-6 / kStep);
  law.Commit(Currents(5e-6));
  EXPECT_EQ(DropOf(law, 5e-6), 0);  // a standing flux costs nothing
}

// Imposed current jumps: φ = φ_static (1 - exp(-ω_c t)), in implicit steps of ω_c h = 5.6e-3, whose
// decay is (1 + ω_c h)^-n: at t = 1/ω_c that is e^-1 (1 + ω_c h/2).
TEST(EddySleeve, FluxFollowsACurrentStepWithOneTimeConstant) {
  Plant plant = PlantWith("eddy-sleeve", "A", {{"cutoff", 400}});
  StatorLanes& lanes = plant.bearings[0].lanes;
  lanes.SetStep(kStep);
  lanes.Settle(Currents(0), 0, 0);
  const double x = 2 * kPi * 400 * kStep;
  const int steps = static_cast<int>(std::lround(1 / x));
  for (int k = 0; k < steps; ++k) lanes.StepCurrents(Currents(2));
  const double followed = lanes.phi[0];
  const double rest = RestFlux(plant, Currents(2))[0];
  EXPECT_NEAR(followed / rest, 1 - std::pow(1 + x, -steps), 1e-9);
  EXPECT_NEAR(followed / rest, 1 - std::exp(-1), 0.5 * x);
}

/// Mean field of rising and falling branch at flux density B [A/m].
double Measured(const std::string& grade, double B) {
  double H = 0;
  for (const char* branch : {"_rising.csv", "_falling.csv"}) {
    std::ifstream file(std::string(AMBRIG_SOURCE_DIR) + "/tests/effects/data/" + grade + branch);
    std::string line;
    std::getline(file, line);
    double h0 = 0, b0 = -100, h = 0, b = 0;
    char comma;
    while (std::getline(file, line) && std::istringstream(line) >> h >> comma >> b) {
      if (b0 < B && B <= b) break;
      h0 = h;
      b0 = b;
    }
    H += 0.5 * (h0 + (h - h0) * (B - b0) / (b - b0));
  }
  return H;
}

TEST(Saturation, CurveIsThatOfElectricalSteel) {
  for (const char* grade : {"M270_50A", "M330_50A", "M400_50A", "M800_65A"}) {
    double knee = 1.2;
    while (Measured(grade, knee) < 1000) knee += 1e-3;
    EXPECT_GT(knee, 1.4) << grade;
    EXPECT_LT(knee, 1.6) << grade;
    int compared = 0;
    for (double B = 1; B < 2.2; B += 0.02) {
      const double wanted = Measured(grade, B);
      if (wanted < 250 || wanted > 20000) continue;
      double H, slope;
      SteelCurve(B / knee, &H, &slope);
      EXPECT_LT(std::abs(std::log(H / wanted)), std::log(1.5)) << grade << " at " << B << " T";
      ++compared;
    }
    EXPECT_GT(compared, 20);
  }
}

TEST(Saturation, SlopeIsTheDerivative) {
  for (double x = -2.5; x < 2.6; x += 0.05) {
    double H, slope, up, down, unused;
    SteelCurve(x, &H, &slope);
    SteelCurve(x + 1e-5, &up, &unused);
    SteelCurve(x - 1e-5, &down, &unused);
    EXPECT_NEAR(slope, (up - down) / 2e-5, 1e-6 * std::abs(slope) + 1e-4)
        << x;  // third derivative x 1e-10/6
    EXPECT_GE(slope, 0) << x;
  }
}

TEST(Saturation, AmperesLawHoldsAtRest) {
  Plant plant = PlantWith("saturation", "A", {{"knee", 0.5}, {"path", 0.1}});
  BearingPlant& b = plant.bearings[0];
  const Lane phi = RestFlux(plant, Currents(5));
  double H, slope;
  SteelCurve(phi[0] * DensityPerFlux(b) / 0.5, &H, &slope);
  // NSNS at equal currents: the rotor's potential is zero, N i = R phi + H path.
  EXPECT_NEAR(std::abs(b.lanes.n[0]) * 5, std::abs(GapReluctanceOf(b) * phi[0] + 0.1 * H),
              1e-9 * 250);
  EXPECT_GT(std::abs(H), 500);
}

/// Energy of one loop of flux density between -B and B, in units N coercive A [T].
double LoopArea(FluxLaw& law, double per_tesla, double B, double mmf) {
  double area = 0, last = 0, last_drop = 0;
  const int steps = 20000;
  for (int k = 0; k <= 5 * steps / 4; ++k) {
    const double b = B * std::asin(std::sin(2 * kPi * k / steps)) * 2 / kPi;  // triangle
    const double drop = DropOf(law, b * per_tesla);
    law.Commit(Currents(b * per_tesla));
    if (k > steps / 4) area += 0.5 * (drop + last_drop) * (b - last);
    last = b;
    last_drop = drop;
  }
  return area / mmf;
}

TEST(Hysteresis, LoopHasTheAreaOfItsStops) {
  Plant plant = PlantWith("hysteresis", "A", {{"coercive", 0.1}, {"width", 0.2}});
  FluxLaw& law = *plant.bearings[0].laws.at(0);
  const double per_tesla = 1 / DensityPerFlux(plant.bearings[0]),
               mmf = 0.1 * std::abs(plant.bearings[0].lanes.n[0]);
  law.Settle(Lane{});
  // Σ over stops of 4 (B - r)/n = 4 (B - width/2); trapezoids at the corners cost (dB/width)² per
  // loop.
  EXPECT_NEAR(LoopArea(law, per_tesla, 0.8, mmf), 4 * (0.8 - 0.1), 1e-4);
  EXPECT_NEAR(DropOf(law, 0.8 * per_tesla), mmf, 1e-9);
}

TEST(Hysteresis, RemembersTurningPointsAndForgetsInnerLoops) {
  Plant plant = PlantWith("hysteresis", "A", {{"coercive", 0.1}, {"width", 0.3}});
  FluxLaw& law = *plant.bearings[0].laws.at(0);
  const double per_tesla = 1 / DensityPerFlux(plant.bearings[0]);
  law.Settle(Lane{});
  const auto go = [&](double B) {
    law.Commit(Currents(B * per_tesla));
    return DropOf(law, B * per_tesla);
  };
  go(0.5);
  const double before = go(0.3);
  const double further = [&] {  // the outer branch without a minor loop
    const double there = go(0.2);
    go(0.5);
    go(0.3);
    return there;
  }();
  EXPECT_NE(go(0.36), before);
  EXPECT_NEAR(go(0.3), before, 1e-12);   // the minor loop closes
  EXPECT_NEAR(go(0.2), further, 1e-12);  // and is forgotten
}

TEST(Hysteresis, CoerciveCurrentAddsToTheCoil) {
  Plant with = PlantWith("hysteresis", "A", {{"coercive", 0.1}, {"width", 0.05}}),
        without = BuildPlant(TrueRig(ReferenceRig()));
  // On the virgin curve far beyond the width the iron takes the coercive current away.
  EXPECT_NEAR(RestFlux(with, Currents(2))[0] / RestFlux(without, Currents(2))[0], 1.9 / 2, 1e-9);
}

}  // namespace
}  // namespace ambrig
