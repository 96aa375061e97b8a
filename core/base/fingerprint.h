#pragma once
/// FNV-1a, 64 bits: whether two inputs are the same.
#include <cstdint>
#include <string>
#include <string_view>

namespace ambrig {

inline std::uint64_t Fingerprint(std::string_view text, std::uint64_t start = 0xcbf29ce484222325u) {
  for (const char ch : text) start = (start ^ static_cast<unsigned char>(ch)) * 0x100000001b3u;
  return start;
}

/// The same as 16 hexadecimal digits.
inline std::string HashText(std::string_view text) {
  std::string digits;
  const std::uint64_t print = Fingerprint(text);
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[(print >> shift) & 15];
  return digits;
}

}  // namespace ambrig
