#include "core/record/mat.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <new>
#include <vector>

#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "core/record/hdf5.h"
#include "core/record/mat_library.h"
#include "core/record/mat_structs.h"
#include "core/record/text_cells.h"
#include "core/record/time_base.h"

namespace ambrig {
namespace {

using namespace mat;  // NOLINT: the door of the library

constexpr std::size_t kMostColumns = 256;  // of a matrix whose columns are channels
constexpr std::string_view kCoherence = "coherence";

std::string ChannelName(std::string name) {
  if (name.size() > 2 && name[0] >= 'A' && name[0] <= 'Z' && name[1] == '_')
    std::replace(name.begin(), name.end(), '_', '.');
  return name;
}

class MatReader {
 public:
  explicit MatReader(const std::string& path) : path_(path) {}

  /// Under the lock of HDF5, which version 7.3 is.
  Measurement Read() {
    const File file(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
    if (!file) throw InputError(path_ + ": not a MAT file of version 5 or 7.3");
    const std::string bytes = ReadFile(path_);
    if (Mat_GetVersion(file.get()) == MAT_FT_MAT5 && CountElements(bytes) < 0)
      throw InputError(path_ + ": damaged or truncated MAT file");
    most_bytes_ = MostBytes(bytes);
    while (const Variable v{Mat_VarReadNext(file.get())}) {
      const std::string name = v->name == nullptr ? "" : v->name;
      if (name == "units" && v->class_type == MAT_C_STRUCT)
        ReadUnits(v.get());
      else
        Add(v.get(), ChannelName(name));
    }
    for (Channel& c : record_.channels)
      if (units_.contains(c.name)) c.unit = units_[c.name];
    if (!frequency_.responses.empty()) return Responses();
    Merge();
    if (record_.channels.empty() && !object_.empty()) throw InputError(path_ + ": " + object_);
    return {std::move(record_), {}};
  }

 private:
  /// Complex vectors and what stands beside them: their axis, their coherence.
  Measurement Responses() {
    Measurement out;
    out.record.notes = std::move(record_.notes);
    for (MeasuredResponse& r : frequency_.responses)
      if (units_.contains(ChannelName(r.name))) r.unit = units_[ChannelName(r.name)];
    for (Channel& c : record_.channels) {
      const std::string name = LowerCase(c.name);
      if (name == "f" || name == "freq" || name == "frequency")
        frequency_.frequency = std::move(c.samples);
      else if (name.ends_with(kCoherence))
        frequency_.coherence.push_back({OfCoherence(c.name), std::move(c.samples)});
      else
        out.record.notes.push_back(path_ + ": " + c.name + " is not complex, left out");
    }
    CheckResponses(frequency_, path_);
    out.frequency = std::move(frequency_);
    return out;
  }

  /// The response of "coherence" (all: empty) or "NAME_coherence".
  std::string OfCoherence(const std::string& name) const {
    if (name.size() <= kCoherence.size() + 1) return "";
    const std::string of = name.substr(0, name.size() - kCoherence.size() - 1);
    for (const MeasuredResponse& r : frequency_.responses)
      if (ChannelName(r.name) == of) return r.name;
    return of;
  }

  void AddComplex(const matvar_t& v, const std::string& name) {
    if (v.rank != 2 || std::min(v.dims[0], v.dims[1]) != 1 || v.data == nullptr)
      return Note(name + " is no complex vector, left out");
    if (const double bytes = Elements(v) * v.data_size; bytes > most_bytes_)
      throw InputError(path_ + ": variable " + name + " cannot be read");
    frequency_.responses.push_back(
        {v.name == nullptr ? name : v.name, "", ComplexNumbers(v, v.dims[0] * v.dims[1])});
  }

  void Add(matvar_t* v, const std::string& name) {
    if (v->class_type == MAT_C_STRUCT) return AddStruct(v, name);
    if (IsObject(*v)) {
      object_ = ObjectText(name);
      return Note(object_ + "; left out");
    }
    if (IsComplex(*v)) return AddComplex(*v, name);
    const bool flat = v->rank == 2 && v->dims[0] > 0 && v->dims[1] > 0;
    if (!flat || !IsNumeric(*v)) return Note(name + " is not a vector of numbers, left out");
    const std::size_t rows = std::max(v->dims[0], v->dims[1]), columns = v->dims[1];
    CheckSize(*v, name);
    std::vector<double> samples = Numbers(*v, v->dims[0] * v->dims[1]);
    if (name == "rate" && samples.size() == 1) {
      record_.rate = samples[0];
    } else if (name == "start" && samples.size() == 1) {
      record_.start = samples[0];
    } else if (samples.size() == 1) {
      Note(name + " is a single number, left out");
    } else if (rows == samples.size()) {
      record_.channels.push_back({name, "", std::move(samples)});
    } else if (rows == columns || columns > v->dims[0] || columns > kMostColumns) {
      Note(name + " is a matrix with more columns than rows or than " +
           std::to_string(kMostColumns) + ", left out");
    } else {
      for (std::size_t c = 0; c < columns; ++c) {
        const auto from = samples.begin() + static_cast<std::ptrdiff_t>(c * rows);
        record_.channels.push_back({name + '(' + std::to_string(c + 1) + ')',
                                    "",
                                    {from, from + static_cast<std::ptrdiff_t>(rows)}});
      }
    }
  }

  void CheckSize(const matvar_t& v, const std::string& name) const {
    const double bytes = Elements(v) * v.data_size;
    if (v.data == nullptr || bytes > most_bytes_ || static_cast<double>(v.nbytes) != bytes)
      throw InputError(path_ + ": variable " + name + " cannot be read");
  }

  void AddStruct(matvar_t* v, const std::string& name) {
    const auto check = [this](const matvar_t& field, const std::string& of) {
      CheckSize(field, of);
    };
    if (const auto timed = ReadTimedStruct(*v, name, path_, check)) {
      for (const std::string& note : timed->notes) Note(note);
      timed_.insert(timed_.end(), timed->channels.begin(), timed->channels.end());
      return;
    }
    for (const std::string& part : FieldNames(*v))
      if (matvar_t* field = FieldOf(*v, part)) Add(field, name + '.' + part);
  }

  void ReadUnits(matvar_t* v) {
    for (const std::string& name : FieldNames(*v))
      if (const matvar_t* field = FieldOf(*v, name)) units_[ChannelName(name)] = Text(*field);
  }

  /// Channels with a time of their own, and the plain vectors that are as long.
  void Merge() {
    for (Channel& c : record_.channels)
      if (c.name == "tout" && !record_.Find("t")) c.name = "t";  // what Simulink calls it
    if (timed_.empty()) return;
    std::vector<Channel> plain = std::move(record_.channels);
    std::vector<std::string> notes = std::move(record_.notes);
    record_ = OneTimeBase(std::move(timed_), path_);
    record_.notes.insert(record_.notes.begin(), notes.begin(), notes.end());
    for (Channel& c : plain) {
      if (IsTimeName(c.name)) continue;
      if (c.samples.size() == record_.rows())
        record_.channels.push_back(std::move(c));
      else
        Note(c.name + " is not as long as the channels with a time, left out");
    }
  }

  void Note(const std::string& text) { record_.notes.push_back(path_ + ": " + text); }

  const std::string& path_;
  double most_bytes_ = 0;
  std::map<std::string, std::string> units_;
  std::vector<TimedChannel> timed_;
  std::string object_;  // why the last object of MATLAB cannot be read
  Record record_;
  FrequencyResponses frequency_;
};

/// The number of the version, in the byte order of its machine, ends the head: 0x0100 is
/// version 5, 0x0200 is HDF5.
bool IsVersion73(const std::string& head) { return head[124] == 2 || head[125] == 2; }

/// A file with the head of version 7.3 by a program that gives its datasets no MATLAB class: plain
/// HDF5 to everyone but MATLAB.
Measurement ReadWithoutClasses(const std::string& path) {
  Measurement out{ReadHdf5(path), {}};
  for (Channel& c : out.record.channels) c.name = ChannelName(c.name);
  return out;
}

}  // namespace

Measurement ReadMatMeasurement(const std::string& path) try {
  const std::string head = ReadFile(path, 128);
  if (head.size() < 128) throw InputError(path + ": not a MAT file");
  const auto read = [&] { return MatReader(path).Read(); };
  if (IsVersion73(head) && !HasObjectWith("MATLAB_class", path)) return ReadWithoutClasses(path);
  Measurement m;
  {
    const std::scoped_lock<std::mutex> lock(Hdf5Mutex());
    if (IsVersion73(head)) RefuseWhatCrashesHdf5(path, read);
    m = read();
  }
  if (m.frequency.responses.empty()) FinishRecord(m.record, path);
  return m;
} catch (const std::bad_alloc&) {
  throw InputError(path + ": damaged, or too large for the memory of this machine");
}

Record ReadMat(const std::string& path) { return ReadMatMeasurement(path).record; }

}  // namespace ambrig
