#pragma once
/// The types of values in TDMS files.
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/record/byte_reader.h"

namespace ambrig {

/// Types of numbers that are read, by their code.
enum TdmsType : std::uint32_t {
  kI8 = 1,
  kI16,
  kI32,
  kI64,
  kU8,
  kU16,
  kU32,
  kU64,
  kSingle,
  kDouble,
  kSingleWithUnit = 0x19,
  kDoubleWithUnit = 0x1a,
  kString = 0x20,
  kBoolean = 0x21,
  kTimestamp = 0x44,
};

/// Bytes of a value; 0 for a type without a fixed size, nullopt for one that is not read.
std::optional<std::size_t> TdmsSize(std::uint32_t type);

/// A value of a type with a size that is no time stamp.
double ReadTdmsNumber(ByteReader& in, std::uint32_t type);

/// A time stamp, since 1904-01-01 UTC.
struct TdmsInstant {
  std::int64_t seconds = 0;
  double fraction = 0;  // [s]
};
TdmsInstant ReadTdmsInstant(ByteReader& in, bool big_endian);

}  // namespace ambrig
