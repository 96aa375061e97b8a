// What a case says of frequency responses and tables: units, weights, and every mistake in one
// line.
#include "discovery/case/response_record.h"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <limits>

#include "core/base/errors.h"
#include "core/math/noise.h"
#include "discovery/case/bench_tables.h"
#include "tests/discovery/bench_case.h"

namespace ambrig {
namespace {

using testing::CaseOf;
using testing::ErrorText;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::WriteBytes;

constexpr const char* kCoherent =
    "f [kHz],Re(P) [um/N],Im(P) [um/N],Coherence(P),Re(S),Im(S)\n"
    "0.05,2,-1,0.99,1,0.1\n0.1,1,-1,0.8,1,0.2\n0.2,0.5,0,0,1,0.3\n9,1,1,0.9,1,0\n";

class CaseBench : public ::testing::Test {
 protected:
  Case Read(const std::string& record, const std::string& data = kCoherent) {
    WriteBytes(folder_.File("data.csv"), data);
    return CaseOf(folder_, "[[record]]\ndata = \"data.csv\"\n" + record);
  }
  std::string Error(const std::string& record, const std::string& data = kCoherent) {
    return ErrorText<InputError>([&] { Read(record, data); });
  }
  const TemporaryFolder folder_;
};

TEST_F(CaseBench, ResponsesInSiOverTheirSd) {
  const Case c = Read(
      "kind = \"frf\"\naverages = 8\naccuracy = 0\n[record.responses]\n\"A.x/A.x.command\" = "
      "\"P\"\n");
  const CaseRecord& r = c.records[0];
  EXPECT_EQ(r.kind, RecordKind::kFrf);
  EXPECT_THAT(r.responses.frequency, ::testing::ElementsAre(50, 100, 200, 9000));
  const RigResponse& p = r.responses.responses[0];
  EXPECT_EQ(p.unit, "m/N");
  EXPECT_EQ(p.excited.name, "A.x.force");
  EXPECT_TRUE(p.sd_known);
  EXPECT_NEAR(std::abs(p.values[0] - std::complex<double>(2e-6, -1e-6)), 0, 1e-18);
  // |H| sqrt((1 - 0.8)/(2 * 6 * 0.8)) = sqrt(2) um/N * sqrt(1/48)
  EXPECT_NEAR(p.sd[1], std::sqrt(2.0 / 48) * 1e-6, 1e-15);
  ASSERT_EQ(r.data.channels.size(), 2u);
  EXPECT_EQ(r.data.channels[0].name, "Re(A.x/A.x.command)");
  EXPECT_NEAR(r.data.channels[1].samples[1], -1e-6 / p.sd[1], 1e-9);
  // nothing coherent at 200 Hz; 9 kHz is beyond half the controller's 12.5 kHz
  EXPECT_THAT(r.quality[0].ok, ::testing::ElementsAre(1, 1, 0, 0));
  EXPECT_THAT(c.notes, ::testing::Contains(HasSubstr("2 of 4 points left out")));
}

// Estimates of averages of a noisy output, as an analyser makes them.
TEST(CoherenceSd, IsTheErrorOfEstimatesOfFewAverages) {
  using Complex = std::complex<double>;
  const Complex H(1.2, -0.7);
  for (const std::uint32_t averages : {6U, 16U, 64U}) {
    double sum = 0;
    constexpr std::uint32_t kEstimates = 20000;
    for (std::uint32_t e = 0; e < kEstimates; ++e) {
      const auto draw = [&](std::uint32_t stream, std::uint32_t k) {
        const std::uint64_t at = 4ULL * (e * averages + k) + stream;
        return Complex(Normal(3, 1, at), Normal(3, 2, at));
      };
      Complex xy;
      double xx = 0, yy = 0;
      for (std::uint32_t k = 0; k < averages; ++k) {
        const Complex x = draw(0, k), y = H * x + 0.5 * draw(1, k);
        xy += std::conj(x) * y, xx += std::norm(x), yy += std::norm(y);
      }
      const double g2 = std::norm(xy) / (xx * yy);
      sum += std::norm(xy / xx - H) / std::pow(CoherenceSd(std::abs(xy / xx), g2, averages), 2);
    }
    EXPECT_NEAR(std::sqrt(sum / (2 * kEstimates)), 1, 0.02) << averages;
  }
}

// sqrt((1 - g²)/(2 (n - 2) g²)): nothing random where all is coherent, nothing known where nothing
// is.
TEST_F(CaseBench, CoherenceTellsTheRandomPart) {
  EXPECT_EQ(CoherenceSd(3, 1, 10), 0);
  EXPECT_NEAR(CoherenceSd(3, 0.5, 8), 3 / std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(CoherenceSd(3, 0.5, 1), 3, 1e-12);
  EXPECT_EQ(CoherenceSd(3, 0, 10), std::numeric_limits<double>::infinity());
}

TEST_F(CaseBench, WithoutCoherenceTheSdIsOpenOrStated) {
  const std::string s = "[record.responses]\n\"A.x.command/A.x.force\" = \"S\"\n";
  EXPECT_FALSE(Read("kind = \"frf\"\n" + s).records[0].responses.responses[0].sd_known);
  const Case c = Read("kind = \"frf\"\nsd = 0.03\naccuracy = 0.04\n" + s);
  const RigResponse& r = c.records[0].responses.responses[0];
  EXPECT_TRUE(r.sd_known);
  EXPECT_NEAR(r.sd[0], 0.05 * std::abs(r.values[0]), 1e-12);
}

// Coherence tells the sd only with the number of averages behind it.
TEST_F(CaseBench, CoherenceWithoutAveragesIsNoted) {
  const std::string p = "[record.responses]\n\"A.x/A.x.command\" = \"P\"\n";
  const Case c = Read("kind = \"frf\"\n" + p);
  EXPECT_FALSE(c.records[0].responses.responses[0].sd_known);
  EXPECT_THAT(c.notes, ::testing::Contains(HasSubstr("coherence without `averages`")));
  EXPECT_THAT(Read("kind = \"frf\"\naverages = 4\n" + p).notes,
              ::testing::Not(::testing::Contains(HasSubstr("coherence without"))));
}

TEST_F(CaseBench, MistakesOfResponses) {
  const std::string frf = "kind = \"frf\"\n[record.responses]\n";
  EXPECT_THAT(Error(frf + "\"A.q/A.x.force\" = \"P\"\n"),
              HasSubstr("\"A.q\" is no point of this rig, allowed: OUTPUT/INPUT of A.x, A.y"));
  EXPECT_THAT(Error(frf + "\"A.x\" = \"P\"\n"), HasSubstr("\"A.x\" is no response"));
  EXPECT_THAT(Error(frf + "\"A.x/A.x.force\" = \"Q\"\n"),
              HasSubstr("trace \"Q\" of A.x/A.x.force is not in data.csv, allowed: P, S"));
  EXPECT_THAT(Error(frf + "\"A.x.force/A.x\" = \"P\"\n"), HasSubstr("a port is no output"));
  EXPECT_THAT(Error(frf + "\"A.i1/A.s1\" = \"S\"\n"), HasSubstr("excited: is missing"));
  EXPECT_THAT(Error("kind = \"frf\"\nexcited = \"foo\"\n[record.responses]\n"
                    "\"A.x.command/A.x.force\" = \"S\"\n"),
              HasSubstr("excited: \"foo\" is no point of this rig"));
  EXPECT_THAT(Error(frf + "\"A.i1/A.coil1.current\" = \"S\"\n"),
              HasSubstr("a coil's needs a scenario with start \"clamped\""));
  EXPECT_THAT(Error(frf + "\"A.x.command/A.x.force\" = \"P\"\n"), HasSubstr("unit um"));
  EXPECT_THAT(Error("kind = \"frf\"\nsped = 3\n[record.responses]\n\"A.x/A.x.force\" = \"P\"\n"),
              HasSubstr("sped"));
  EXPECT_THAT(Error("kind = \"frf\"\n", "t [s],A.x [m]\n0,1\n0.1,2\n"),
              HasSubstr("holds no frequency responses"));
  EXPECT_THAT(Error("kind = \"frq\"\n"), HasSubstr("frf"));
  for (const char* gain : {"0.0", "inf", "nan"})
    EXPECT_NE(Error(frf + "\"A.x/A.x.force\" = { trace = \"P\", gain = " + gain + " }\n"), "");
}

TEST_F(CaseBench, TablesWithTheirWeights) {
  const std::string table = "gap [mm],I [A],F [N]\n0.05,1,2\n-0.05,2,nan\n0,2,8\n";
  const std::string channels =
      "[record.channels]\n\"A.x\" = \"gap\"\n\"A.i1\" = \"I\"\n\"A.fx\" = \"F\"\n";
  const Case c =
      Read("kind = \"static\"\naccuracy = 0.03\n[record.sd]\n\"A.fx\" = 0.08\n" + channels, table);
  const CaseRecord& r = c.records[0];
  EXPECT_EQ(r.kind, RecordKind::kStatic);
  ASSERT_EQ(r.table.inputs.size(), 2u);
  EXPECT_NEAR(r.table.inputs[1].samples[0], 5e-5, 1e-12);
  EXPECT_EQ(r.table.inputs[1].name, "A.x");
  EXPECT_NEAR(r.table.sd[0][0], 0.1, 1e-12);  // hypot(0.08, 0.03 * 2)
  EXPECT_THAT(r.quality[0].ok, ::testing::ElementsAre(1, 0, 1));
  EXPECT_THAT(Error("kind = \"static\"\n[record.channels]\n\"A.x\" = \"gap\"\n", table),
              HasSubstr("holds no force or inductance of this rig"));
  EXPECT_THAT(Error("kind = \"static\"\n[record.sd]\n\"A.fy\" = 1.0\n" + channels, table),
              HasSubstr("is no output of this table"));
}

TEST_F(CaseBench, ImpedancesAtAFrequency) {
  const std::string table = "gap [mm],L_1k [mH],R [ohm]\n0.05,2,3\n0,3,4\n";
  const std::string gap = "kind = \"static\"\n[record.channels]\n\"A.x\" = \"gap\"\n";
  const Case c = Read(gap + "\"A.L1@1000\" = \"L_1k\"\n\"A.R1@2.5e4\" = \"R\"\n", table);
  ASSERT_EQ(c.records[0].table.outputs.size(), 2u);
  EXPECT_EQ(c.records[0].table.outputs[0].name, "A.L1@1000");
  EXPECT_NEAR(c.records[0].table.outputs[0].samples[1], 3e-3, 1e-15);
  EXPECT_EQ(MeterFrequency("A.R1@2.5e4"), 25000);
  EXPECT_EQ(MeterFrequency("A.R1"), 0);
  for (const char* key : {"A.L1@1kHz", "A.L1@", "A.L1@-5", "A.fx@50"})
    EXPECT_THAT(Error(gap + "\"" + key + "\" = \"L_1k\"\n", table),
                HasSubstr("is no impedance at a frequency, allowed: A.L1@1000"))
        << key;
  EXPECT_THAT(Error(gap + "\"A.M1@50\" = \"L_1k\"\n", table),
              HasSubstr("is not a channel of this rig"));
}

}  // namespace
}  // namespace ambrig
