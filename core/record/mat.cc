#include "core/record/mat.h"

#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "core/record/hdf5.h"
#include "core/record/time_base.h"

namespace ambrig {
namespace {

struct Closer {
  void operator()(mat_t* file) const { Mat_Close(file); }
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, Closer>;
using Variable = std::unique_ptr<matvar_t, Closer>;

/// Number of elements of a v5 file, -1 when one ends beyond the end of the file: the library takes
/// a truncated file for a shorter one.
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

std::string ChannelName(std::string name) {
  if (name.size() > 2 && name[0] >= 'A' && name[0] <= 'Z' && name[1] == '_')
    std::replace(name.begin(), name.end(), '_', '.');
  return name;
}

std::string VariableName(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

template <class T>
std::vector<double> ToDoubles(const matvar_t& v, std::size_t n) {
  std::vector<T> raw(n);  // the library promises no alignment
  std::memcpy(raw.data(), v.data, n * sizeof(T));
  return {raw.begin(), raw.end()};
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

/// Text of a char row; the elements are bytes of UTF-8 or 16-bit code units.
std::string Text(const matvar_t& v) {
  std::string text;
  if (v.class_type != MAT_C_CHAR || v.data == nullptr) return text;
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

class MatReader {
 public:
  explicit MatReader(const std::string& path) : path_(path) {}

  Record Read() {
    const std::scoped_lock<std::mutex> lock(Hdf5Mutex());  // v7.3 is HDF5
    const File file(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
    if (!file) throw InputError(path_ + ": not a MAT file of version 5 or 7.3");
    if (Mat_GetVersion(file.get()) == MAT_FT_MAT5 && CountElements(ReadFile(path_)) < 0)
      throw InputError(path_ + ": damaged or truncated MAT file");
    while (const Variable v{Mat_VarReadNext(file.get())}) {
      const std::string name = v->name == nullptr ? "" : v->name;
      if (name == "units" && v->class_type == MAT_C_STRUCT)
        ReadUnits(v.get());
      else
        Add(v.get(), ChannelName(name));
    }
    for (Channel& c : record_.channels) c.unit = units_[c.name];
    return std::move(record_);
  }

 private:
  void Add(matvar_t* v, const std::string& name) {
    if (v->class_type == MAT_C_STRUCT) return AddFields(v, name);
    std::size_t n = 1;
    for (int d = 0; d < v->rank; ++d) n *= v->dims[d];
    const bool vector = v->rank == 2 && (v->dims[0] == 1 || v->dims[1] == 1) && n > 0;
    const bool number = v->class_type >= MAT_C_DOUBLE && v->class_type <= MAT_C_UINT64;
    if (!vector || !number || v->isComplex != 0 || v->isLogical != 0)
      return Note(name + " is not a vector of numbers, left out");
    if (v->data == nullptr || v->nbytes != n * static_cast<std::size_t>(v->data_size))
      throw InputError(path_ + ": variable " + name + " cannot be read");
    std::vector<double> samples = Numbers(*v, n);
    if (name == "rate" && n == 1) {
      record_.rate = samples[0];
    } else if (name == "start" && n == 1) {
      record_.start = samples[0];
    } else if (n == 1) {
      Note(name + " is a single number, left out");
    } else {
      record_.channels.push_back({name, "", std::move(samples)});
    }
  }

  void AddFields(matvar_t* v, const std::string& name) {
    char* const* names = Mat_VarGetStructFieldnames(v);
    for (unsigned k = 0; k < Mat_VarGetNumberOfFields(v); ++k)
      if (matvar_t* field = Mat_VarGetStructFieldByIndex(v, k, 0))
        Add(field, name + '.' + names[k]);
  }

  void ReadUnits(matvar_t* v) {
    char* const* names = Mat_VarGetStructFieldnames(v);
    for (unsigned k = 0; k < Mat_VarGetNumberOfFields(v); ++k)
      if (const matvar_t* field = Mat_VarGetStructFieldByIndex(v, k, 0))
        units_[ChannelName(names[k])] = Text(*field);
  }

  void Note(const std::string& text) { record_.notes.push_back(path_ + ": " + text); }

  const std::string& path_;
  std::map<std::string, std::string> units_;
  Record record_;
};

class MatWriter {
 public:
  MatWriter(const std::string& path, const std::string& temporary)
      : path_(path), file_(Mat_CreateVer(temporary.c_str(), "ambrig record", MAT_FT_MAT5)) {
    if (!file_) throw InputError("cannot write " + path_ + ": the file cannot be created");
  }

  void Vector(const std::string& name, const std::vector<double>& samples) {
    std::size_t dims[2] = {samples.size(), 1};
    // The library does not write through this pointer, its signature only is older than const.
    Put(Variable(Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims,
                               const_cast<double*>(samples.data()), MAT_F_DONT_COPY_DATA)));
  }

  void Units(const std::vector<Channel>& channels) {
    std::vector<std::string> names;
    std::vector<const char*> fields;
    for (const Channel& c : channels) names.push_back(VariableName(c.name));
    for (const std::string& name : names) fields.push_back(name.c_str());
    std::size_t one[2] = {1, 1};
    Variable v(
        Mat_VarCreateStruct("units", 2, one, fields.data(), static_cast<unsigned>(fields.size())));
    for (std::size_t k = 0; v && k < channels.size(); ++k) {
      std::string text = channels[k].unit;
      std::size_t dims[2] = {1, text.size()};
      Mat_VarSetStructFieldByIndex(
          v.get(), k, 0, Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, dims, text.data(), 0));
    }
    Put(std::move(v));
  }

 private:
  void Put(const Variable& v) {
    if (!v || Mat_VarWrite(file_.get(), v.get(), MAT_COMPRESSION_NONE) != 0)
      throw InputError("cannot write " + path_ + ": the library refuses a variable");
  }

  const std::string& path_;
  File file_;
};

/// The header's text carries the date; the same record shall be the same bytes.
std::string WithoutDate(std::string bytes) {
  const std::string text = "MATLAB 5.0 MAT-file, record of ambrig";
  bytes.replace(0, 116, text + std::string(116 - text.size(), ' '));
  return bytes;
}

}  // namespace

Record ReadMat(const std::string& path) {
  if (ReadFile(path, 128).size() < 128) throw InputError(path + ": not a MAT file");
  Record record = MatReader(path).Read();
  FinishRecord(record, path);
  return record;
}

void WriteMat(const Record& record, const std::string& path) {
  CheckRecord(record, "cannot write " + path);
  AtomicFile draft(path);  // for the library, which reports no full disk
  {
    MatWriter writer(path, draft.temporary());
    for (const Channel& c : record.channels) writer.Vector(VariableName(c.name), c.samples);
    writer.Vector("rate", {record.rate});
    writer.Vector("start", {record.start});
    writer.Units(record.channels);
  }
  const std::string bytes = ReadFile(draft.temporary());
  if (bytes.size() < 128 || CountElements(bytes) != static_cast<int>(record.channels.size()) + 3)
    throw InputError("cannot write " + path + ": not all data could be written (disk full?)");
  WriteFileAtomically(path, WithoutDate(bytes));
}

}  // namespace ambrig
