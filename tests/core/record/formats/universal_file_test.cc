// Universal Files written after the specification of data set 58 (SOURCE.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "core/record/read_record.h"
#include "core/record/units.h"
#include "tests/core/record/formats/instrument_files.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using testing::ErrorText;
using ::testing::HasSubstr;
using testing::InstrumentFile;
using ::testing::Pointwise;
using testing::SignalX;
using testing::SignalY;
using ::testing::StartsWith;

// E13.5 has six digits: half a unit of the last one of numbers below 10.
constexpr double kSixDigits = 5e-6;

TEST(UniversalFile, SeveralFunctionsBecomeOneRecordAndItsResponses) {
  std::string format;
  const Measurement m = ReadMeasurement(InstrumentFile("uff_ascii.unv"), &format);
  EXPECT_EQ(format, "UFF 58");
  const Record& r = m.record;
  EXPECT_EQ(r.rate, 3000);  // 3.33333E-04 s in the file
  EXPECT_EQ(r.start, 0.5);
  ASSERT_EQ(r.channels.size(), 2U);
  EXPECT_EQ(r.channels[0].name, "A.x");
  EXPECT_EQ(r.channels[0].unit, "um");
  EXPECT_THAT(r.channels[0].samples, Pointwise(DoubleNear(kSixDigits), SignalX()));
  EXPECT_EQ(r.channels[1].name, "A.i1");
  EXPECT_THAT(r.channels[1].samples, Pointwise(DoubleNear(1e-12), SignalY()));
  // Uneven spacing, other rate.
  EXPECT_THAT(r.notes, ElementsAre(HasSubstr("B.x has 10 rows at 1500 Hz from 0.5 s on, others")));
  ASSERT_EQ(m.frequency.responses.size(), 2U);
  EXPECT_THAT(m.frequency.frequency, ElementsAre(10, 12.5, 15, 17.5, 20, 22.5, 25, 27.5, 30, 32.5));
  const double near[] = {kSixDigits, 1e-12};  // single and double precision
  for (int k : {0, 1}) {
    const MeasuredResponse& h = m.frequency.responses[static_cast<std::size_t>(k)];
    EXPECT_EQ(h.name, k == 0 ? "A.x/H1" : "A.x/H2");
    EXPECT_EQ(h.unit, "m/N");
    for (std::size_t n = 0; n < h.values.size(); ++n) {
      EXPECT_NEAR(h.values[n].real(), SignalX()[n], near[k]);
      EXPECT_NEAR(h.values[n].imag(), SignalY()[n], near[k]);
    }
  }
}

TEST(UniversalFile, BinaryInBothByteOrdersAndPrecisions) {
  for (const char* name : {"uff_little_single.uff", "uff_big_double.uff",
                           "uff_little_double_uneven.uff", "uff_big_single_uneven.uff"}) {
    const Record r = ReadRecord(InstrumentFile(name));
    // A single-precision time near 1 s is rounded to 6e-8 s, 6e-5 of a period; over nine periods.
    EXPECT_NEAR(r.rate, 1000, 0.02) << name;
    EXPECT_NEAR(r.start, 1, 1e-7) << name;
    ASSERT_EQ(r.channels.size(), 1U) << name;
    const bool single = std::string(name).find("single") != std::string::npos;
    EXPECT_THAT(r.channels[0].samples, Pointwise(DoubleNear(single ? 6e-8 : 0), SignalX())) << name;
  }
  for (const char* name : {"uff_little_double_complex.uff", "uff_big_single_complex.uff"}) {
    const Measurement m = ReadMeasurement(InstrumentFile(name));
    ASSERT_EQ(m.frequency.responses.size(), 1U) << name;
    EXPECT_EQ(m.frequency.responses[0].name, "A.x") << name;
    for (std::size_t k = 0; k < 10; ++k) {
      EXPECT_NEAR(m.frequency.responses[0].values[k].real(), SignalX()[k], 6e-8) << name;
      EXPECT_NEAR(m.frequency.responses[0].values[k].imag(), SignalY()[k], 0) << name;
    }
  }
}

TEST(UniversalFile, UnitsBeyondAsciiAndWrongSizes) {
  const Record sine = ReadRecord(InstrumentFile("uff_binary_double.uff"));
  EXPECT_EQ(sine.rate, 100);
  EXPECT_EQ(sine.rows(), 250U);
  EXPECT_EQ(sine.channels[0].unit, "g");
  // 5 Hz; the stated number of bytes is wrong, as some programs write it.
  for (std::size_t k = 0; k < 250; ++k)
    EXPECT_NEAR(sine.channels[0].samples[k], std::sin(0.1 * M_PI * static_cast<double>(k)), 1e-15);
  const Record casing = ReadRecord(InstrumentFile("uff_units.uff"));
  EXPECT_EQ(casing.rate, 20000);
  EXPECT_EQ(casing.rows(), 13U);
  EXPECT_EQ(casing.channels[0].unit, "m/s²");
  EXPECT_EQ(SiUnit(casing.channels[0].unit), "m/s2");
  EXPECT_EQ(casing.channels[0].samples.back(), -0.44252);
  // Latin-1 in the unit "(1/N)*(m/s²)".
  const Measurement latin = ReadMeasurement(InstrumentFile("uff_latin1.uff"));
  ASSERT_EQ(latin.frequency.responses.size(), 1U);
  EXPECT_EQ(latin.frequency.responses[0].unit, "(1/N)*(m/s²)");
  EXPECT_EQ(latin.frequency.responses[0].values[5], std::complex<double>(0.997495, 2.5));
  EXPECT_NEAR(latin.frequency.frequency[5], 1.25, 1e-12);
}

TEST(UniversalFile, ResponsesAreNoRecordOverTime) {
  const std::string path = InstrumentFile("uff_latin1.uff");
  EXPECT_EQ(ErrorText<InputError>([&] { ReadRecord(path); }),
            path +
                ": holds frequency responses (1, 6 points from 0 to 1.25 Hz), allowed here: a "
                "record over time");
}

TEST(UniversalFile, DamageIsNamedByLineOrByte) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.File("a.unv");
  const auto error = [&](const std::string& file, const std::string& from, const std::string& to) {
    std::string bytes = testing::ReadBytes(InstrumentFile(file));
    const std::size_t at = bytes.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    testing::WriteBytes(path, bytes.replace(at, from.size(), to));
    const std::string text = ErrorText<InputError>([&] { ReadMeasurement(path); });
    return text.starts_with(path) ? text.substr(path.size()) : "wrong file: " + text;
  };
  EXPECT_EQ(
      error("uff_ascii.unv", "         2        10", "         7        10"),
      ":13: ordinate type 7, allowed 2, 4 (real), 5, 6 (complex) in a record 7 of 3I10,3E13.5");
  EXPECT_EQ(error("uff_ascii.unv", "         2        10", "         2999999999"),
            ":20: the function ends after 10 of 999999999 numbers");
  EXPECT_EQ(error("uff_ascii.unv", "  5.64642E-01", "  5.6x642E-01"),
            ":18: '5.6x642E-01' is not a number");
  EXPECT_EQ(error("uff_units.uff", "    58", "    57"), ": no data set 58 (function) in the file");
  EXPECT_THAT(error("uff_binary_double.uff", "         4       250", "         4  99999999"),
              ::testing::AllOf(StartsWith(": byte "), HasSubstr("99999999 points of 8 bytes")));
  EXPECT_THAT(error("uff_binary_double.uff", "58b     1     2", "58b     1     1"),
              StartsWith(":2: 58b with byte order '1' and numbers of kind '1', allowed"));
  EXPECT_THAT(error("uff_little_single.uff", "  1.00000E-03", "  0.00000E+00"),
              HasSubstr("allowed: steps above 0"));
}

/// Data set 58 of four points at 10, 20, 30, 40 Hz (records 6 to 11 by the specification).
std::string FrequencyFunction(int type, int ordinate, const std::string& values) {
  const std::string axis = "    0    0    0                 NONE                 NONE\n";
  return "    -1\n    58\nNONE\nNONE\nNONE\nNONE\nNONE\n    " + std::to_string(type) +
         "         1    1         0        A.x         1   1         F1         2   1\n" +
         "         " + std::to_string(ordinate) +
         "         4         1  1.00000E+01  1.00000E+01  0.00000E+00\n" + "        18" + axis +
         "         0" + axis + "         0" + axis + "         0" + axis + values + "    -1\n";
}

// Type 6 is a coherence: of the response with the same names.
TEST(UniversalFile, CoherenceOfAResponse) {
  const testing::TemporaryFolder folder;
  testing::WriteBytes(
      folder.File("a.unv"),
      FrequencyFunction(4, 5,
                        "  1.00000E+00  0.00000E+00  2.00000E+00  1.00000E+00  3.00000E+00  "
                        "2.00000E+00\n  4.00000E+00  3.00000E+00\n") +
          FrequencyFunction(6, 2, "  1.00000E+00  9.00000E-01  8.00000E-01  5.00000E-01\n"));
  const Measurement m = ReadMeasurement(folder.File("a.unv"));
  ASSERT_EQ(m.frequency.responses.size(), 1U);
  EXPECT_EQ(m.frequency.responses[0].values[3], std::complex<double>(4, 3));
  ASSERT_EQ(m.frequency.coherence.size(), 1U);
  EXPECT_EQ(m.frequency.coherence[0].name, m.frequency.responses[0].name);
  EXPECT_THAT(m.frequency.coherence[0].values, ElementsAre(1, 0.9, 0.8, 0.5));
}

// Each data set has an abscissa of its own: 10 to 40 Hz and 15 to 45 Hz.
TEST(UniversalFile, ResponsesOverDifferentFrequencies) {
  const testing::TemporaryFolder folder;
  const std::string values =
      "  1.00000E+00  0.00000E+00  2.00000E+00  1.00000E+00  3.00000E+00  2.00000E+00\n"
      "  4.00000E+00  3.00000E+00\n";
  std::string other = FrequencyFunction(4, 5, values);
  other.replace(other.find("A.x"), 3, "B.x");
  other.replace(other.find("1.00000E+01"), 11, "1.50000E+01");
  testing::WriteBytes(folder.File("a.unv"), FrequencyFunction(4, 5, values) + other);
  const FrequencyResponses f = ReadMeasurement(folder.File("a.unv")).frequency;
  EXPECT_THAT(f.frequency, ElementsAre(10, 15, 20, 25, 30, 35, 40, 45));
  ASSERT_EQ(f.responses.size(), 2U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(std::isnan(f.responses[0].values[k].real()), k % 2 == 1) << k;
    EXPECT_EQ(std::isnan(f.responses[1].values[k].real()), k % 2 == 0) << k;
  }
  EXPECT_EQ(f.responses[1].values[7], std::complex<double>(4, 3));
}

}  // namespace
}  // namespace ambrig
