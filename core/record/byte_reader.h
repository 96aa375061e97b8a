#pragma once
/// Numbers of a binary file that is in memory, in either byte order; never beyond its end.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "core/base/errors.h"

namespace ambrig {

class ByteReader {
 public:
  /// `path` is for messages.
  ByteReader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  std::size_t at() const { return at_; }
  std::size_t left() const { return end() - at_; }
  std::size_t end() const { return bytes_.size(); }
  void big_endian(bool yes) { big_endian_ = yes; }
  void Go(std::size_t at) {
    if (at > end()) Fail("position " + std::to_string(at) + " is behind the end of the file");
    at_ = at;
  }

  /// @throws InputError "FILE: byte N: ..."
  std::string_view Take(std::size_t count) {
    if (count > left())
      Fail(std::to_string(count) + " bytes expected, the file has " + std::to_string(left()));
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  /// An integer, float or double.
  template <class T>
  T Number() {
    char raw[sizeof(T)];
    std::memcpy(raw, Take(sizeof(T)).data(), sizeof(T));
    if (big_endian_ == (std::endian::native == std::endian::little))
      std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(path_ + ": byte " + std::to_string(at_) + ": " + what);
  }

 private:
  const std::string& path_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool big_endian_ = false;
};

}  // namespace ambrig
