#include "core/record/read_record.h"

#include <algorithm>
#include <filesystem>

#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "core/record/csv.h"
#include "core/record/hdf5.h"
#include "core/record/mat.h"

namespace ambrig {
namespace {

enum class Kind { kHdf5, kCsv, kMat, kUnknown };

std::string Extension(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

Kind ByExtension(const std::string& extension) {
  if (extension == ".h5" || extension == ".hdf5") return Kind::kHdf5;
  if (extension == ".csv" || extension == ".txt" || extension == ".tsv") return Kind::kCsv;
  if (extension == ".mat") return Kind::kMat;
  return Kind::kUnknown;
}

// A v7.3 MAT file has 512 bytes of its own before the HDF5 signature, so the order matters.
Kind ByContent(const std::string& start) {
  if (start.starts_with("MATLAB ")) return Kind::kMat;
  if (start.starts_with("\x89HDF\r\n\x1a\n")) return Kind::kHdf5;
  const auto is_text = [](char c) {
    return static_cast<unsigned char>(c) >= 32 || c == '\t' || c == '\n' || c == '\r';
  };
  const bool text = !start.empty() && std::all_of(start.begin(), start.end(), is_text);
  return text && start.find_first_of(",;\t") != std::string::npos ? Kind::kCsv : Kind::kUnknown;
}

}  // namespace

Record ReadRecord(const std::string& path) {
  Kind kind = ByExtension(Extension(path));
  if (kind == Kind::kUnknown) kind = ByContent(ReadFile(path, 512));
  switch (kind) {
    case Kind::kHdf5:
      return ReadHdf5(path);
    case Kind::kCsv:
      return ReadCsv(path);
    case Kind::kMat:
      return ReadMat(path);
    case Kind::kUnknown:
      break;
  }
  throw InputError(path +
                   ": unknown kind of file, allowed HDF5 (.h5 .hdf5), CSV (.csv .txt), MAT (.mat)");
}

}  // namespace ambrig
