/// MATLAB files, written (mat.h).
#include <algorithm>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "core/record/mat.h"
#include "core/record/mat_library.h"
#include "core/record/time_base.h"

namespace ambrig {
namespace {

using namespace mat;  // NOLINT: the door of the library

std::string VariableName(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

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
