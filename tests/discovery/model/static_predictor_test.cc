// Static tables against closed forms and against the switching engine's load cells.
#include "discovery/model/static_predictor.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "effects/catalogue.h"
#include "tests/discovery/bench_case.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

using testing::CaseOf;
using testing::TemporaryFolder;
using testing::WriteBytes;

std::vector<std::vector<double>> Predicted(const Case& c, const RigParameters& rig) {
  std::vector<std::vector<double>> columns;
  EXPECT_TRUE(StaticPredictor(c, c.records[0]).Predict(rig, columns));
  for (std::size_t o = 0; o < columns.size(); ++o)
    for (std::size_t k = 0; k < columns[o].size(); ++k)
      columns[o][k] *= c.records[0].table.sd[o][k];
  return columns;
}

/// Pole area 2e-4 m², gap 0.4 mm, 100 turns, bias 2 A, poles at 22.5 degrees and so on.
RigParameters WithTextbookBearing(RigParameters rig) {
  for (BearingParameters& b : rig.bearings) {
    b.radial.turns = 100;
    b.radial.pole_area = 2e-4;
    b.radial.gap = 4e-4;
    b.radial.first_pole_angle_deg = 22.5;
  }
  return rig;
}

/// Rows (x, i) of the differential drive in x: quadrant +x carries 2 A + i, -x 2 A - i, y 2 A.
std::string DifferentialTable(const std::vector<std::pair<double, double>>& rows) {
  std::string text = "A.x [m]";
  for (int j = 1; j <= 8; ++j) text += fmt::format(",A.i{} [A]", j);
  text += ",A.fx [N]\n";
  for (const auto& [x, i] : rows) {
    text += fmt::format("{}", x);
    // poles 1 and 8 stand at +-22.5 degrees, 4 and 5 at 180 -+ 22.5
    for (int j = 1; j <= 8; ++j)
      text += fmt::format(",{}", 2 + (j == 1 || j == 8 ? i : j == 4 || j == 5 ? -i : 0));
    text += ",0\n";
  }
  return text;
}

// k_i = 2 A B0²/(mu0 i0) Σ cos over a quadrant, k_s = n A B0²/(2 mu0 g0), B0 = mu0 N i0/g0:
// 116.0981 N/A and 628 318.5 N/m. The force is linear in i, so a difference of any size gives k_i.
TEST(StaticPredictor, TextbookBearing) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("table.csv"),
             DifferentialTable({{0, 0.5}, {0, -0.5}, {1e-7, 0}, {-1e-7, 0}}));
  const Case c = CaseOf(folder, "[[record]]\nkind = \"static\"\ndata = \"table.csv\"\n");
  const auto f = Predicted(c, WithTextbookBearing(c.rig));
  ASSERT_EQ(f.size(), 1u);
  EXPECT_NEAR(f[0][0] - f[0][1], 116.0981, 1e-4);
  // (Δx/g0)² = 6e-8 of the slope
  EXPECT_NEAR((f[0][2] - f[0][3]) / 2e-7, 628318.5, 0.2);
}

// dL/di of one coil alone: N² P (1 - P/ΣP) with equal permeances, plus leakage; the linkage is L i.
TEST(StaticPredictor, InductanceAndLinkageOfOneCoil) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("table.csv"), "i [mA],L [mH],lambda [Wb]\n500,10,0.01\n1500,10,0.01\n");
  const Case c = CaseOf(folder,
                        "[[record]]\nkind = \"static\"\ndata = \"table.csv\"\n[record.channels]\n"
                        "\"A.i1\" = \"i\"\n\"A.L1\" = \"L\"\n\"A.lambda1\" = \"lambda\"\n");
  const auto v = Predicted(c, c.rig);
  ASSERT_EQ(v.size(), 2u);
  const RadialStatorParameters& b = c.rig.bearings[0].radial;
  const double P = 4e-7 * 3.14159265358979 * b.pole_area / b.gap;
  const double L = b.turns * b.turns * P * 7 / 8 + b.leakage_inductance;
  for (std::size_t k : {0u, 1u}) {
    EXPECT_NEAR(v[0][k], L, 1e-6 * L);
    EXPECT_NEAR(v[1][k], L * (k == 0 ? 0.5 : 1.5), 1e-6 * L);
  }
}

// Standing currents of the switching engine read by its load cells, with saturated iron: the mean
// of the current's ripple and the force's agree to its square.
TEST(StaticPredictor, LoadCellsOfAHeldSaturatedRotor) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("table.csv"), "A.x [um],A.i1 [A],A.fx [N],A.fy [N]\n60,3,1,1\n");
  const Case c = CaseOf(folder, "[[record]]\nkind = \"static\"\ndata = \"table.csv\"\n");
  RigParameters rig = c.rig;
  rig.effects = {MakeInstance(EffectNamed("saturation"), "A")};
  rig.effects[0].Set("knee", 0.5);
  const auto f = Predicted(c, rig);
  const auto ideal = Predicted(c, c.rig);
  EXPECT_LT(f[0][0], 0.97 * ideal[0][0]);
  Scenario s;
  s.name = "held";
  s.noise = s.fault_tolerant = false;
  s.start = StartState::kClamped;
  s.clamp["A"] = {6e-5, 0};
  s.clamp["B"] = {0, 0};
  s.duration = 0.1;
  s.record_rate = rig.controller.rate;
  Excitation e;
  e.target = "A.coil1";
  e.port = "current";
  e.kind = "step";
  e.amplitude = 3;
  s.excitations = {e};
  EngineOptions options;
  options.watch = options.coil_spread = false;
  const Record r = SwitchingEngine(rig, s, options).Run().record;
  EXPECT_NEAR(r.Find("A.fx")->samples.back(), f[0][0], 0.005 * f[0][0]);
  EXPECT_NEAR(r.Find("A.fy")->samples.back(), f[1][0], 0.005 * f[0][0]);
}

/// Reads what an LCR meter shows of coil 1 at two frequencies, with one effect of the iron.
std::vector<std::vector<double>> MeterReadings(const TemporaryFolder& folder, const char* effect,
                                               double cutoff) {
  WriteBytes(folder.File("table.csv"), "i [mA],a [mH],b [mH],c [ohm],d [ohm]\n500,1,1,1,1\n");
  const Case c = CaseOf(folder,
                        "[[record]]\nkind = \"static\"\ndata = \"table.csv\"\n[record.channels]\n"
                        "\"A.i1\" = \"i\"\n\"A.L1@200\" = \"a\"\n\"A.L1@5000\" = \"b\"\n"
                        "\"A.R1@200\" = \"c\"\n\"A.R1@5000\" = \"d\"\n");
  RigParameters rig = c.rig;
  rig.effects = {MakeInstance(EffectNamed(effect), "A")};
  rig.effects[0].Set("cutoff", cutoff);
  return Predicted(c, rig);
}

/// Coil 1 alone, equal gaps: L(f) = L_l + 7/8 N² P/(1 + T(f)) with T what the iron adds to each
/// gap.
std::complex<double> InductanceOf(const RadialStatorParameters& b, std::complex<double> added) {
  const double P = 4e-7 * 3.14159265358979 * b.pole_area / b.gap;
  return b.leakage_inductance + b.turns * b.turns * P * (7.0 / 8) / (1.0 + added);
}

// A closed conductor: T = j f/cutoff. Steps of 1/64 and 1/128 of a cycle extrapolated leave (ω h)²
// of the loss, 2.4e-3 at 1/128.
TEST(StaticPredictor, MetersInductanceBehindASleeve) {
  const TemporaryFolder folder;
  const auto v = MeterReadings(folder, "eddy-sleeve", 1000);
  const RigParameters rig = ReadRig(testing::kSpindle);
  ASSERT_EQ(v.size(), 4u);  // by name: L at 200 and 5000 Hz, then R
  for (const auto& [column, f] : {std::pair{0u, 200.0}, std::pair{1u, 5000.0}}) {
    const std::complex<double> L = InductanceOf(rig.bearings[0].radial, {0, f / 1000});
    EXPECT_NEAR(v[column][0], L.real(), 3e-3 * std::abs(L)) << f;
    EXPECT_NEAR(v[column + 2][0], rig.bearings[0].radial.resistance - 6.283185307 * f * L.imag(),
                3e-3 * 6.283185307 * f * std::abs(L))
        << f;
  }
  EXPECT_LT(v[1][0], 0.5 * v[0][0]);
}

// Diffusion into thick iron: T = sqrt(j f/cutoff), whose relaxations are within 1 % and 1 degree.
TEST(StaticPredictor, MetersInductanceOfThickIron) {
  const TemporaryFolder folder;
  const auto v = MeterReadings(folder, "eddy-currents", 1000);
  const RigParameters rig = ReadRig(testing::kSpindle);
  for (const auto& [column, f] : {std::pair{0u, 200.0}, std::pair{1u, 5000.0}}) {
    const std::complex<double> L =
        InductanceOf(rig.bearings[0].radial, std::sqrt(std::complex<double>(0, f / 1000)));
    EXPECT_NEAR(v[column][0], L.real(), 0.02 * std::abs(L)) << f;
    EXPECT_NEAR(v[column + 2][0], rig.bearings[0].radial.resistance - 6.283185307 * f * L.imag(),
                0.02 * 6.283185307 * f * std::abs(L))
        << f;
  }
}

// A column of frequencies says the same row by row.
TEST(StaticPredictor, FrequencyOfEachRow) {
  const TemporaryFolder folder;
  const auto by_name = MeterReadings(folder, "eddy-sleeve", 1000);
  WriteBytes(folder.File("rows.csv"), "i [mA],f [kHz],L [mH]\n500,0.2,1\n500,5,1\n");
  const Case c = CaseOf(folder,
                        "[[record]]\nkind = \"static\"\ndata = \"rows.csv\"\n[record.channels]\n"
                        "\"A.i1\" = \"i\"\nfrequency = \"f\"\n\"A.L1\" = \"L\"\n");
  RigParameters rig = c.rig;
  rig.effects = {MakeInstance(EffectNamed("eddy-sleeve"), "A")};
  rig.effects[0].Set("cutoff", 1000);
  const auto v = Predicted(c, rig);
  EXPECT_EQ(v[0][0], by_name[0][0]);
  EXPECT_EQ(v[0][1], by_name[1][0]);
}

}  // namespace
}  // namespace ambrig
