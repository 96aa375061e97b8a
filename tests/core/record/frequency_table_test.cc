// Frequency responses in text: Bode 100, tables of parts, SR785 traces.
#include "core/record/frequency_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "core/record/read_record.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;
using testing::ErrorText;
using ::testing::HasSubstr;

class FrequencyTable : public ::testing::Test {
 protected:
  Measurement Read(const std::string& text) {
    testing::WriteBytes(path_, text);
    return ReadMeasurement(path_);
  }
  std::string Error(const std::string& text) {
    const std::string error = ErrorText<InputError>([&] { Read(text); });
    return error.starts_with(path_) ? error.substr(path_.size()) : "wrong file: " + error;
  }
  static void ExpectNear(std::complex<double> got, std::complex<double> wanted) {
    EXPECT_NEAR(std::abs(got - wanted), 0, 1e-12) << got << " " << wanted;
  }

  const testing::TemporaryFolder folder_;
  const std::string path_ = folder_.File("a.csv");
};

TEST_F(FrequencyTable, Bode100MagnitudeAndPhaseAsTwoTraces) {
  // Latin-1 as well as UTF-8 signs of the degree; decimal commas.
  for (const char* degree : {"\xc2\xb0", "\xb0", "deg"}) {
    const Measurement m =
        Read(std::string("Frequency (Hz);Trace 1: Gain: Magnitude (dB);Trace 2: Gain: Phase (") +
             degree + ")\r\n10;0;90\r\n20,5;-20;180\r\n");
    EXPECT_TRUE(m.record.channels.empty());
    EXPECT_THAT(m.frequency.frequency, ElementsAre(10, 20.5));
    ASSERT_EQ(m.frequency.responses.size(), 1U);
    EXPECT_EQ(m.frequency.responses[0].name, "Trace 1: Gain");
    EXPECT_EQ(m.frequency.responses[0].unit, "");
    ExpectNear(m.frequency.responses[0].values[0], {0, 1});
    ExpectNear(m.frequency.responses[0].values[1], -0.1);
  }
}

TEST_F(FrequencyTable, Bode100RealAndImaginaryParts) {
  const Measurement m =
      Read("Frequency (Hz);Trace 1: Gain: Real ;Trace 1: Gain: Imag \n1;2;3\n2;4;5\n");
  ASSERT_EQ(m.frequency.responses.size(), 1U);
  EXPECT_THAT(m.frequency.responses[0].values,
              ElementsAre(std::complex<double>(2, 3), std::complex<double>(4, 5)));
}

TEST_F(FrequencyTable, CoherenceStandsBesideItsResponse) {
  const Measurement m = Read(
      "f [Hz],Re(P),Im(P),Coherence(P),Re(S),Im(S),S coherence [%]\n1,2,3,0.9,4,5,80\n2,2,3,1,4,5,"
      "75\n");
  ASSERT_EQ(m.frequency.responses.size(), 2U);
  ASSERT_EQ(m.frequency.coherence.size(), 2U);
  EXPECT_EQ(m.frequency.coherence[0].name, "P");
  EXPECT_THAT(m.frequency.coherence[0].values, ElementsAre(0.9, 1));
  EXPECT_EQ(m.frequency.coherence[1].name, "S");
  EXPECT_THAT(m.frequency.coherence[1].values, ElementsAre(0.8, 0.75));
  EXPECT_TRUE(m.record.notes.empty());
  EXPECT_THAT(Error("f [Hz],Re(P),Im(P),Coherence\n1,2,3,1.2\n"),
              HasSubstr("point 1 = 1.2, allowed: 0 to 1"));
}

TEST_F(FrequencyTable, PartsByTheirNames) {
  const Measurement m = Read(
      "f [kHz],Re(x) [mm],Im(x) [mm],Abs(y) [A],Phi(y) [rad],z [V],Re(w)\n"
      "0.01,1,2,3,0,9,1\n0.02,4,5,6,3.141592653589793,9,1\n");
  EXPECT_THAT(m.frequency.frequency, ElementsAre(10, 20));
  ASSERT_EQ(m.frequency.responses.size(), 2U);
  EXPECT_EQ(m.frequency.responses[0].name, "x");
  EXPECT_EQ(m.frequency.responses[0].unit, "mm");
  ExpectNear(m.frequency.responses[0].values[1], {4, 5});
  EXPECT_EQ(m.frequency.responses[1].name, "y");
  EXPECT_EQ(m.frequency.responses[1].unit, "A");
  ExpectNear(m.frequency.responses[1].values[1], -6);
  EXPECT_THAT(m.record.notes, ElementsAre(HasSubstr("z is no real or imaginary part"),
                                          HasSubstr("Re(w) has no partner")));
}

TEST_F(FrequencyTable, AngularFrequenciesBecomeHertz) {
  const Measurement m = Read("freq [rad/s];Magnitude;Phase (deg)\n6.283185307179586;2;0\n");
  EXPECT_NEAR(m.frequency.frequency[0], 1, 1e-15);
  EXPECT_EQ(m.frequency.responses[0].name, "response");
}

TEST_F(FrequencyTable, AForceOrATimeIsNoFrequency) {
  EXPECT_EQ(Read("f [N],t [s]\n1,0\n2,1\n").record.Find("f")->samples[1], 2);
  EXPECT_THAT(Error("f [N],x\n1,0\n2,1\n"), HasSubstr("neither a rate [Hz] nor a time channel"));
}

TEST_F(FrequencyTable, Errors) {
  EXPECT_EQ(Error("f,Abs(x),Phi(x)\n1,2,3\n"), ": Phi(x): unit missing, allowed deg, rad");
  EXPECT_EQ(Error("f,Re(x),Im(x)\n2,2,3\n1,2,3\n"),
            ": frequency 2 = 1 Hz, allowed: finite, not negative, increasing");
  EXPECT_THAT(Error("f,Re(x)\n2,2\n"), HasSubstr("frequencies, but no response: allowed are"));
  EXPECT_EQ(Error("f,Re(x) [mm],Im(x) [m]\n2,2,2\n"),
            ": Re(x) [mm] and Im(x) [m]: allowed: one unit");
}

TEST_F(FrequencyTable, TracesOfAnSr785HaveNoFrequencies) {
  // The example of the manual: a 400 line FFT, shortened.
  std::string text = "5\n";
  for (int k = 0; k < 5; ++k) text += std::to_string(k) + ".000, " + std::to_string(k) + ".500\n";
  const Measurement m = Read(text);
  EXPECT_TRUE(m.frequency.frequency.empty());
  ASSERT_EQ(m.frequency.points(), 5U);
  EXPECT_EQ(m.frequency.responses[0].values[4], std::complex<double>(4, 4.5));
  EXPECT_EQ(Error("6" + text.substr(1)), ": 5 points, the first line says 6");
  EXPECT_EQ(Error("2\n1, 2\n3; 4\n"), ":3: '3; 4', expected: real, imaginary");
  testing::WriteBytes(path_, text);
  EXPECT_EQ(ErrorText<InputError>([&] { ReadRecord(path_); }),
            path_ + ": holds frequency responses (1, 5 points), allowed here: a record over time");
}

}  // namespace
}  // namespace ambrig
