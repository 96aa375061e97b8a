#include "core/record/formats/tdms_types.h"

#include <cmath>

namespace ambrig {

std::optional<std::size_t> TdmsSize(std::uint32_t type) {
  switch (type) {
    case kI8:
    case kU8:
    case kBoolean:
      return 1;
    case kI16:
    case kU16:
      return 2;
    case kI32:
    case kU32:
    case kSingle:
    case kSingleWithUnit:
      return 4;
    case kI64:
    case kU64:
    case kDouble:
    case kDoubleWithUnit:
      return 8;
    case kTimestamp:
      return 16;
    case kString:
      return 0;
    default:
      return std::nullopt;
  }
}

double ReadTdmsNumber(ByteReader& in, std::uint32_t type) {
  switch (type) {
    case kI8:
      return in.Number<std::int8_t>();
    case kU8:
    case kBoolean:
      return in.Number<std::uint8_t>();
    case kI16:
      return in.Number<std::int16_t>();
    case kU16:
      return in.Number<std::uint16_t>();
    case kI32:
      return in.Number<std::int32_t>();
    case kU32:
      return in.Number<std::uint32_t>();
    case kI64:
      return static_cast<double>(in.Number<std::int64_t>());
    case kU64:
      return static_cast<double>(in.Number<std::uint64_t>());
    case kSingle:
    case kSingleWithUnit:
      return in.Number<float>();
    default:
      return in.Number<double>();
  }
}

// With little endian the fraction comes first.
TdmsInstant ReadTdmsInstant(ByteReader& in, bool big_endian) {
  TdmsInstant out;
  if (big_endian) out.seconds = in.Number<std::int64_t>();
  out.fraction = std::ldexp(static_cast<double>(in.Number<std::uint64_t>()), -64);
  if (!big_endian) out.seconds = in.Number<std::int64_t>();
  return out;
}

}  // namespace ambrig
