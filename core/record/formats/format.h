#pragma once
/// A kind of file that records are read from. Each is described by a function in a file of this
/// folder and by one line of catalogue.cc.
#include <span>
#include <string>
#include <string_view>

#include "core/record/measurement.h"

namespace ambrig {

struct RecordFormat {
  std::string_view name;        // for messages and lists
  std::string_view extensions;  // ".csv .txt", small letters; empty: by its content alone
  /// Whether a file that begins so (at most kRecognised bytes) is of this kind.
  bool (*recognises)(std::string_view begin);
  /// Units as in the file. @throws InputError that names the file and the line or byte
  Measurement (*read)(const std::string& path);
};

inline constexpr std::size_t kRecognised = 4096;

/// All, in the order in which they are asked for their content.
std::span<const RecordFormat> RecordFormats();

}  // namespace ambrig
