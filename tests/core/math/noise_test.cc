#include "core/math/noise.h"

#ifdef __x86_64__
#pragma GCC push_options
#pragma GCC target("aes,sse4.1")
#define R123_USE_AES_NI 1
#include <Random123/ars.h>
#pragma GCC pop_options
#endif
#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "core/math/aes_round.h"
#include "core/math/noise_dispatch.h"
#include "core/math/normal_table.h"

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

// FIPS 197, appendix B: rounds 1 and 10 of the example.
TEST(Noise, AesRoundsAreThoseOfTheStandard) {
  const AesState first = {0xbee33d19, 0x2be2f4a0, 0x2a8dc69a, 0x0848f8e9},
                 key1 = {0x17fefaa0, 0xb12c5488, 0x3939a323, 0x05766c2a};
  const AesState second = {0xf27f9ca4, 0x2b359f68, 0x43ea5b6b, 0x49506a02};
  EXPECT_EQ(AesRound(first, key1), second);
  const AesState tenth = {0x1ef240eb, 0x84382e59, 0xe713a18b, 0xd242c31b},
                 key10 = {0xa8f914d0, 0x8925eec9, 0xc80c3fe1, 0xa60c63b6};
  const AesState cipher = {0x1d842539, 0xfb09dc02, 0x978511dc, 0x320b6a19};
  EXPECT_EQ(AesLastRound(tenth, key10), cipher);
}

// The lowest bit is the sign; P(|z| > value) = p from the others.
void ExpectNormalOf(std::uint32_t word, float value) {
  EXPECT_EQ(std::signbit(value), (word & 1) != 0);
  const double size = std::abs(double{value}), p = ((word >> 1) + 0.5) * 0x1p-31;
  const double density = std::sqrt(2 / M_PI) * std::exp(-0.5 * size * size);
  EXPECT_NEAR(std::erfc(size / std::sqrt(2.0)), p, 4.5e-5 * density + 0x1p-24 * p) << word;
}

#ifdef __x86_64__
__attribute__((target("aes,sse4.1"))) std::array<std::uint32_t, 4> Ars(
    std::array<std::uint32_t, 4> counter, std::uint64_t seed) {
  const ars4x32_ctr_t c = {{counter[0], counter[1], counter[2], counter[3]}};
  const ars4x32_ukey_t k = {
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), 0, 0}};
  const ars4x32_ctr_t out = ars4x32_R(5, c, ars4x32keyinit(k));
  return {out.v[0], out.v[1], out.v[2], out.v[3]};
}

// Value 4 c + w of a block from word w of counter (c, stream, index).
TEST(Noise, ValuesAreNormalsOfTheBitsOfRandom123) {
  if (!__builtin_cpu_supports("aes")) GTEST_SKIP() << "Random123 needs AES instructions";
  const std::uint64_t seed = 0x123456789abcdefULL, index = 0xfedcba9876ULL;
  const std::uint32_t stream = 77;
  const std::vector<float> block = Block(seed, stream, index, kBlock);
  for (std::uint32_t c = 0; c < kBlock / 4; ++c) {
    const auto words =
        Ars({c, stream, static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32)},
            seed);
    for (std::uint32_t w = 0; w < 4; ++w) ExpectNormalOf(words[w], block[4 * c + w]);
  }
}
#endif

// Every octave of the table, also those that a test's draws never reach.
TEST(Noise, TableOfTheInverseDistributionIsWithinItsError) {
  for (int e = 0; e <= 30; ++e)
    for (int k = 0; k <= 1000; ++k) {
      const double t = k / 1000.0 - 0.5, p = std::ldexp(1.5 + t, e - 31);
      double size = 0;
      for (int power = kNormalDegree; power >= 0; --power)
        size = size * t + double{kNormalTable[power][(e + 127) % 32]};
      const double density = std::sqrt(2 / M_PI) * std::exp(-0.5 * size * size);
      ASSERT_NEAR((std::erfc(size / std::sqrt(2.0)) - p) / density, 0, 4e-5) << e << ' ' << t;
    }
  for (const auto& row : kNormalTable) EXPECT_EQ(row[30], 0);  // p = 1/2 and p = 2^31
}

TEST(Noise, EveryCloneGivesTheSameBits) {
  for (int n : {1, 7, 8, 31, 32, 33, 64, 65, 144, 360}) {
    std::vector<float> expected(n + 1, 99.0F), got = expected;
    FillFromBaseline(5, 6, 7, expected.data(), n);
    const auto same = [&] { return std::memcmp(expected.data(), got.data(), 4 * n + 4) == 0; };
    FillNormals(5, 6, 7, got.data(), n);
    EXPECT_TRUE(same()) << n;
#ifdef __x86_64__
    std::fill(got.begin(), got.end(), 99.0F);
    if (HasAvx2()) FillFromAvx2(5, 6, 7, got.data(), n);
    EXPECT_TRUE(!HasAvx2() || same()) << "AVX2, " << n;
    std::fill(got.begin(), got.end(), 99.0F);
    if (HasVaes()) FillFromVaes(5, 6, 7, got.data(), n);
    EXPECT_TRUE(!HasVaes() || same()) << "VAES, " << n;
    std::fill(got.begin(), got.end(), 99.0F);
    if (HasAvx512()) FillFromAvx512(5, 6, 7, got.data(), n);
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
  EXPECT_EQ(hash, 9811798033350460339ULL);
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
  // Words of one counter (1 to 3), of neighbouring counters (4), blocks (360).
  for (std::size_t lag : {1u, 2u, 3u, 4u, 16u, 32u, 360u}) {
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
