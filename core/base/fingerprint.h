#pragma once
/// FNV-1a, 64 bits: whether two inputs are the same.
#include <cstdint>
#include <string_view>

namespace ambrig {

inline std::uint64_t Fingerprint(std::string_view text, std::uint64_t start = 0xcbf29ce484222325u) {
  for (const char ch : text) start = (start ^ static_cast<unsigned char>(ch)) * 0x100000001b3u;
  return start;
}

}  // namespace ambrig
