#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/record/mat_library.h"

namespace ambrig::mat {

namespace {

constexpr double kStoredPart = 8, kDeflation = 1032;
constexpr std::size_t kLongestText = 1 << 16;  // bytes of a name, a unit, a label

template <class T>
std::vector<double> ToDoubles(const matvar_t& v, std::size_t n) {
  std::vector<T> raw(n);  // the library promises no alignment
  std::memcpy(raw.data(), v.data, n * sizeof(T));
  return {raw.begin(), raw.end()};
}

}  // namespace

int CountElements(const std::string& bytes) {
  const bool swapped = bytes.compare(126, 2, "MI") == 0;
  int count = 0;
  std::size_t at = 128;
  for (; at + 8 <= bytes.size(); ++count) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + at + 4, sizeof size);
    at += 8 + (swapped ? __builtin_bswap32(size) : size);
  }
  return at == bytes.size() ? count : -1;
}

double MostBytes(const std::string& bytes) {
  const bool plain = bytes.size() >= 128 && bytes.compare(0, 10, "MATLAB 5.0") == 0;
  if (!plain) return kStoredPart * kDeflation * static_cast<double>(bytes.size());
  const bool swapped = bytes.compare(126, 2, "MI") == 0;
  double most = 0;
  for (std::size_t at = 128; at + 8 <= bytes.size();) {
    std::uint32_t type = 0, size = 0;
    std::memcpy(&type, bytes.data() + at, sizeof type);
    std::memcpy(&size, bytes.data() + at + 4, sizeof size);
    if (swapped) type = __builtin_bswap32(type), size = __builtin_bswap32(size);
    const double factor = type == MAT_T_COMPRESSED ? kStoredPart * kDeflation : kStoredPart;
    most = std::max(most, factor * static_cast<double>(size));
    at += 8 + static_cast<std::size_t>(size);
  }
  return most;
}

double Elements(const matvar_t& v) {
  double n = v.dims == nullptr ? 0 : 1;
  for (int d = 0; v.dims != nullptr && d < v.rank; ++d) n *= static_cast<double>(v.dims[d]);
  return n;
}

bool IsNumeric(const matvar_t& v) {
  return v.class_type >= MAT_C_DOUBLE && v.class_type <= MAT_C_UINT64 && v.isComplex == 0 &&
         v.isLogical == 0;
}

std::vector<double> Numbers(const matvar_t& v, std::size_t n) {
  switch (v.class_type) {
    case MAT_C_DOUBLE:
      return ToDoubles<double>(v, n);
    case MAT_C_SINGLE:
      return ToDoubles<float>(v, n);
    case MAT_C_INT8:
      return ToDoubles<std::int8_t>(v, n);
    case MAT_C_UINT8:
      return ToDoubles<std::uint8_t>(v, n);
    case MAT_C_INT16:
      return ToDoubles<std::int16_t>(v, n);
    case MAT_C_UINT16:
      return ToDoubles<std::uint16_t>(v, n);
    case MAT_C_INT32:
      return ToDoubles<std::int32_t>(v, n);
    case MAT_C_UINT32:
      return ToDoubles<std::uint32_t>(v, n);
    case MAT_C_INT64:
      return ToDoubles<std::int64_t>(v, n);
    case MAT_C_UINT64:
      return ToDoubles<std::uint64_t>(v, n);
    default:
      return {};
  }
}

bool IsComplex(const matvar_t& v) {
  return v.class_type >= MAT_C_DOUBLE && v.class_type <= MAT_C_UINT64 && v.isComplex != 0;
}

std::vector<std::complex<double>> ComplexNumbers(const matvar_t& v, std::size_t n) {
  const auto* split = static_cast<const mat_complex_split_t*>(v.data);
  matvar_t part = v;  // its numbers only
  part.data = split->Re;
  const std::vector<double> re = Numbers(part, n);
  part.data = split->Im;
  const std::vector<double> im = Numbers(part, n);
  std::vector<std::complex<double>> out(re.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = {re[k], im[k]};
  return out;
}

std::string Text(const matvar_t& v) {
  std::string text;
  if (v.class_type != MAT_C_CHAR || v.data == nullptr || v.nbytes > kLongestText) return text;
  const auto* bytes = static_cast<const unsigned char*>(v.data);
  for (std::size_t k = 0; k + 1 <= v.nbytes; k += v.data_size == 2 ? 2 : 1) {
    unsigned code = bytes[k];
    if (v.data_size == 2) code |= bytes[k + 1] * 256U;
    const bool wide = v.data_size == 2 || v.data_type == MAT_T_UINT8;
    if (code < 0x80 || !wide) {
      text += static_cast<char>(code);
    } else if (code < 0x800) {
      text += {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
    } else {
      text += {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3f)),
               static_cast<char>(0x80 | (code & 0x3f))};
    }
  }
  return text;
}

std::vector<std::string> FieldNames(const matvar_t& v) {
  std::vector<std::string> names;
  if (v.class_type != MAT_C_STRUCT || v.data == nullptr) return names;
  char* const* all = Mat_VarGetStructFieldnames(&v);
  if (all == nullptr) return names;
  for (unsigned k = 0; k < Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&v)); ++k)
    names.emplace_back(all[k] == nullptr ? "" : all[k]);
  return names;
}

// Not by the library's own look-up: it believes the sizes of a damaged file.
matvar_t* FieldOf(const matvar_t& v, const std::string& name, std::size_t index) {
  const std::vector<std::string> names = FieldNames(v);
  const auto it = std::find(names.begin(), names.end(), name);
  if (it == names.end()) return nullptr;
  const auto field = static_cast<std::size_t>(it - names.begin());
  const std::size_t held = v.nbytes / sizeof(matvar_t*);
  if (index >= held / names.size()) return nullptr;
  return static_cast<matvar_t* const*>(v.data)[index * names.size() + field];
}

}  // namespace ambrig::mat
