#pragma once
/// FNV-1a, 64 bits: whether two inputs are the same, and whether a line came back as it was
/// written.
#include <cstdint>
#include <string>
#include <string_view>

namespace ambrig {

inline std::uint64_t Fingerprint(std::string_view text, std::uint64_t start = 0xcbf29ce484222325u) {
  for (const char ch : text) start = (start ^ static_cast<unsigned char>(ch)) * 0x100000001b3u;
  return start;
}

/// A line of a journal with its check sum, ended.
std::string CheckedLine(const std::string& text);
/// The text of such a line (without its end); empty when it is not what was written.
std::string_view Unchecked(std::string_view line);

}  // namespace ambrig
