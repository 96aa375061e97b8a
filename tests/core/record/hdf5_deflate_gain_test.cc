// Which channels are compressed: told from what deflate does to their first samples.
#include "core/record/hdf5_deflate_gain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/math/noise.h"
#include "core/record/hdf5.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

constexpr std::size_t kRows = 20000;

/// Currents about 2 A with 10 mA of noise; `step` > 0: as a converter reads them [A].
std::vector<double> Readings(double step) {
  std::vector<double> v(kRows);
  for (std::size_t k = 0; k < kRows; ++k) {
    v[k] = 2 + 0.01 * Normal(7, 0, k);
    if (step > 0) v[k] = step * std::round(v[k] / step);
  }
  return v;
}

TEST(Hdf5DeflateGain, ConstantsAndConverterReadingsPayNoiseInEveryDigitDoesNot) {
  EXPECT_TRUE(DeflatePays(std::vector<double>(kRows, 3.7)));
  EXPECT_TRUE(DeflatePays(Readings(0.0049)));
  EXPECT_FALSE(DeflatePays(Readings(0)));
  EXPECT_FALSE(DeflatePays({}));
}

TEST(Hdf5DeflateGain, AFileHoldsBothAndGivesTheSameBitsBack) {
  Record record{1000, 0};
  record.channels = {{"A.i1", "A", Readings(0.0049)}, {"A.x", "m", Readings(0)}};
  const testing::TemporaryFolder folder;
  WriteHdf5(record, folder.File("a.h5"));
  const double plain = kRows * sizeof(double);
  const auto size = static_cast<double>(std::filesystem::file_size(folder.File("a.h5")));
  EXPECT_GT(size, plain);
  EXPECT_LT(size, 1.6 * plain);
  const Record back = ReadHdf5(folder.File("a.h5"));
  for (std::size_t c = 0; c < 2; ++c)
    EXPECT_EQ(back.channels[c].samples, record.channels[c].samples) << c;
}

}  // namespace
}  // namespace ambrig
