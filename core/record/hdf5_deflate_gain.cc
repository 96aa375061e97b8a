#include "core/record/hdf5_deflate_gain.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

namespace ambrig {

namespace {

constexpr std::size_t kLookedAt = 2048;  // samples
constexpr double kPays = 2.0 / 3;        // of the size

std::vector<unsigned char> Shuffled(const double* samples, std::size_t count) {
  std::vector<unsigned char> bytes(count * sizeof(double));
  for (std::size_t k = 0; k < count; ++k) {
    unsigned char one[sizeof(double)];
    std::memcpy(one, samples + k, sizeof one);
    for (std::size_t b = 0; b < sizeof one; ++b) bytes[b * count + k] = one[b];
  }
  return bytes;
}

}  // namespace

bool DeflatePays(const std::vector<double>& samples) {
  const std::vector<unsigned char> bytes =
      Shuffled(samples.data(), std::min(samples.size(), kLookedAt));
  uLongf size = compressBound(bytes.size());
  std::vector<unsigned char> out(size);
  return compress2(out.data(), &size, bytes.data(), bytes.size(), Z_BEST_SPEED) == Z_OK &&
         static_cast<double>(size) < kPays * static_cast<double>(bytes.size());
}

}  // namespace ambrig
