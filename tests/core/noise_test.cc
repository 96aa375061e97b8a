#include "core/math/noise.h"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "core/math/noise_dispatch.h"

namespace ambrig {
namespace {

constexpr int kBlock = 360;

std::vector<float> Block(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, int n) {
  std::vector<float> out(n);
  FillNormals(seed, stream, index, out.data(), n);
  return out;
}

/// `blocks` consecutive blocks, about 1e6 values for the statistics below.
std::vector<float> Sample(std::uint64_t seed, std::uint32_t stream, int blocks = 2800) {
  std::vector<float> all;
  for (int k = 0; k < blocks; ++k) {
    const std::vector<float> block = Block(seed, stream, k, kBlock);
    all.insert(all.end(), block.begin(), block.end());
  }
  return all;
}

double Correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += double{a[k]} * b[k];
  return sum / static_cast<double>(a.size());  // means 0, variances 1
}

TEST(Noise, PhiloxGivesTheBitsOfRandom123) {
  for (std::uint32_t k = 0; k < 1000; ++k) {
    const std::uint32_t m = k == 0 ? 0 : k == 1 ? 0xffffffffU : 2654435761U * k;
    const philox4x32_ctr_t counter = {{m, m ^ (k << 7), m + k * k, m - k}};
    const philox4x32_key_t key = {{m ^ 0x5555U * k, m + 77 * k}};
    const philox4x32_ctr_t expected = philox4x32_R(7, counter, key);
    const auto got =
        Philox4x32({counter.v[0], counter.v[1], counter.v[2], counter.v[3]}, {key.v[0], key.v[1]});
    for (int w = 0; w < 4; ++w) ASSERT_EQ(got[w], expected.v[w]) << "case " << k;
  }
}

// Value 8 m + j of chunk c from counter (8 c + j, stream, index) by Box and Muller, here in double
// precision with the library's functions: error of r below 1e-6, of the angle 1e-6 r.
TEST(Noise, ValuesAreBoxMullerOfThoseBits) {
  const std::uint64_t seed = 0x123456789abcdefULL, index = 0xfedcba9876ULL;
  const std::uint32_t stream = 77;
  const std::vector<float> block = Block(seed, stream, index, kBlock);
  for (int k = 0; k < kBlock; ++k) {
    const std::uint32_t counter = 8 * (k / 32) + k % 8;
    const int m = k % 32 / 8;
    const philox4x32_ctr_t w =
        philox4x32_R(7,
                     philox4x32_ctr_t{{counter, stream, static_cast<std::uint32_t>(index),
                                       static_cast<std::uint32_t>(index >> 32)}},
                     philox4x32_key_t{{static_cast<std::uint32_t>(seed),
                                       static_cast<std::uint32_t>(seed >> 32)}});
    const double u = ((w.v[m / 2 * 2] >> 1) + 0.5) * 0x1p-31;
    const double angle = 2 * M_PI * w.v[m / 2 * 2 + 1] * 0x1p-32;
    const double r = std::sqrt(-2 * std::log(u));
    // u near 1 has 24 bits as a float: dr = du / (u r), du <= 2^-25.
    const double tolerance = 1e-6 * (1 + r) + 0x1p-25 / r;
    EXPECT_NEAR(block[k], r * (m % 2 == 0 ? std::cos(angle) : std::sin(angle)), tolerance) << k;
  }
}

TEST(Noise, EveryCloneGivesTheSameBits) {
  for (int n : {1, 7, 8, 31, 32, 33, 64, 65, 144, 360}) {
    std::vector<float> expected(n + 1, 99.0F), got = expected;
    FillFromBaseline(5, 6, 7, 0, expected.data(), n);
    const auto same = [&] { return std::memcmp(expected.data(), got.data(), 4 * n + 4) == 0; };
    FillNormals(5, 6, 7, got.data(), n);
    EXPECT_TRUE(same()) << n;
#ifdef __x86_64__
    std::fill(got.begin(), got.end(), 99.0F);
    if (HasAvx2()) FillFromAvx2(5, 6, 7, 0, got.data(), n);
    EXPECT_TRUE(!HasAvx2() || same()) << "AVX2, " << n;
    std::fill(got.begin(), got.end(), 99.0F);
    if (HasAvx512()) FillFromAvx512(5, 6, 7, 0, got.data(), n);
    EXPECT_TRUE(!HasAvx512() || same()) << "AVX-512, " << n;
#endif
    EXPECT_EQ(expected[n], 99.0F);  // nothing behind the end
  }
}

// Pins the bits for other compilers and machines: FNV-1a of 100 blocks.
TEST(Noise, BitsArePinned) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (int index = 0; index < 100; ++index)
    for (float x : Block(1, 2, index, kBlock)) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &x, 4);
      hash = (hash ^ bits) * 1099511628211ULL;
    }
  EXPECT_EQ(hash, 12971039637675072672ULL);
}

TEST(Noise, LongerBlocksBeginWithShorterOnes) {
  const std::vector<float> longest = Block(1, 2, 3, kBlock);
  for (int n : {0, 1, 33, 144}) {
    const std::vector<float> shorter = Block(1, 2, 3, n);
    EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longest.begin())) << n;
  }
}

TEST(Noise, EveryPartOfThePlaceMatters) {
  std::set<float> firsts;
  for (std::uint64_t seed : {1ULL, 2ULL, 1ULL << 32})
    for (std::uint32_t stream : {0U, 1U, 0x80000000U})
      for (std::uint64_t index : {0ULL, 1ULL, 1ULL << 32, 1ULL << 63})
        firsts.insert(Block(seed, stream, index, 1)[0]);
  EXPECT_EQ(firsts.size(), 36u);
}

// Bounds are five standard deviations of each estimate for n independent values.
TEST(Noise, Moments) {
  const std::vector<float> sample = Sample(1, 2);
  const double n = static_cast<double>(sample.size());
  double m[5] = {};
  for (float x : sample)
    for (int p = 1; p < 5; ++p) m[p] += std::pow(double{x}, p) / n;
  EXPECT_NEAR(m[1], 0, 5 * std::sqrt(1 / n));
  EXPECT_NEAR(m[2], 1, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(m[3], 0, 5 * std::sqrt(15 / n));
  EXPECT_NEAR(m[4], 3, 5 * std::sqrt(96 / n));
}

// Kolmogorov-Smirnov: P(sqrt(n) D > 2.2) = 2 exp(-2 * 2.2²) = 1.3e-4.
TEST(Noise, DistributionIsNormal) {
  for (std::uint64_t seed : {1, 2, 3}) {
    std::vector<float> sample = Sample(seed, 9);
    std::sort(sample.begin(), sample.end());
    const double n = static_cast<double>(sample.size());
    double worst = 0;
    for (std::size_t k = 0; k < sample.size(); ++k) {
      const double cdf = 0.5 * std::erfc(-double{sample[k]} / std::sqrt(2.0));
      worst = std::max({worst, cdf - k / n, (k + 1) / n - cdf});
    }
    EXPECT_LT(worst * std::sqrt(n), 2.2);
  }
}

// Counts beyond a limit are binomial; five standard deviations.
TEST(Noise, TailsHaveTheirShare) {
  const std::vector<float> sample = Sample(4, 1);
  const double n = static_cast<double>(sample.size());
  for (double limit : {2.0, 3.0, 4.0}) {
    const double p = 0.5 * std::erfc(limit / std::sqrt(2.0));
    const double above =
        std::count_if(sample.begin(), sample.end(), [&](float x) { return x > limit; });
    const double below =
        std::count_if(sample.begin(), sample.end(), [&](float x) { return x < -limit; });
    EXPECT_NEAR(above, n * p, 5 * std::sqrt(n * p)) << limit;
    EXPECT_NEAR(below, n * p, 5 * std::sqrt(n * p)) << limit;
  }
}

TEST(Noise, StreamsIndicesSeedsAndNeighboursAreIndependent) {
  const std::vector<float> a = Sample(1, 2);
  const double bound = 5 / std::sqrt(static_cast<double>(a.size()));
  EXPECT_NEAR(Correlation(a, Sample(1, 3)), 0, bound);
  EXPECT_NEAR(Correlation(a, Sample(2, 2)), 0, bound);
  // Neighbours inside a block, the partners of Box and Muller (8), chunks (32), blocks (360).
  for (std::size_t lag : {1u, 2u, 8u, 16u, 32u, 360u}) {
    const std::vector<float> head(a.begin(), a.end() - lag), tail(a.begin() + lag, a.end());
    EXPECT_NEAR(Correlation(head, tail), 0, bound) << lag;
    double squares = 0;  // also of the magnitudes; variance of (x² - 1)(y² - 1) is 4
    for (std::size_t k = 0; k < head.size(); ++k)
      squares += (double{head[k]} * head[k] - 1) * (double{tail[k]} * tail[k] - 1);
    EXPECT_NEAR(squares / static_cast<double>(head.size()), 0, 2 * bound) << lag;
  }
}

TEST(Noise, SingleNormals) {
  const int n = 100000;
  double sum = 0, squares = 0, products = 0;
  for (int k = 0; k < n; ++k) {
    const double x = Normal(1, 2, k);
    sum += x;
    squares += x * x;
    products += x * Block(1, 2, k, 1)[0];
  }
  EXPECT_NEAR(sum / n, 0, 5 * std::sqrt(1.0 / n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(products / n, 0, 5 * std::sqrt(1.0 / n));
  EXPECT_EQ(Normal(1, 2, 3), Normal(1, 2, 3));
}

}  // namespace
}  // namespace ambrig
