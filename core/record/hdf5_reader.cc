#include <filesystem>
#include <new>
#include <optional>
#include <set>

#include "core/base/trial_copy.h"
#include "core/record/hdf5_library.h"
#include "core/record/time_base.h"

namespace ambrig {
namespace {

using namespace hdf5;

constexpr hsize_t kMaxRows = hsize_t{1} << 31;  // a damaged header must not ask for all memory

std::optional<std::string> ReadTextAttribute(hid_t object, const std::string& name) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (!attribute.usable()) return std::nullopt;
  const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
    return std::nullopt;
  const Handle memory(H5Tcopy(type), H5Tclose);  // as stored: HDF5 converts no kind into the other
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute, memory, &text) < 0) return std::nullopt;
    std::string result = text == nullptr ? "" : text;
    H5free_memory(text);
    return result;
  }
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, memory, text.data()) < 0) return std::nullopt;
  text.resize(std::min(text.size(), text.find('\0')));
  if (H5Tget_strpad(type) == H5T_STR_SPACEPAD) text.resize(text.find_last_not_of(' ') + 1);
  return text;
}

std::optional<double> ReadNumber(hid_t file, const char* name) {
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.usable()) return std::nullopt;
  const Handle space(H5Aget_space(attribute), H5Sclose);
  double value = 0;
  if (H5Sget_simple_extent_npoints(space) != 1 || H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
    return std::nullopt;
  return value;
}

/// Rows of a vector, also of an n x 1 or 1 x n matrix; nothing for any other shape.
std::optional<hsize_t> VectorRows(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank != 1 && rank != 2) return std::nullopt;
  hsize_t dims[2] = {1, 1};
  H5Sget_simple_extent_dims(space, dims, nullptr);
  if (rank == 2 && dims[0] != 1 && dims[1] != 1) return std::nullopt;
  return dims[0] * dims[1];
}

bool IsSingle(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  return H5Sget_simple_extent_npoints(space) == 1;
}

/// External storage and virtual datasets name files anywhere on the disk.
bool RefersElsewhere(hid_t dataset) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  return H5Pget_external_count(creation) > 0 || H5Pget_layout(creation) == H5D_VIRTUAL;
}

class Hdf5Traversal {
 public:
  Hdf5Traversal(const std::string& path, Record& record) : path_(path), record_(record) {}

  void ReadGroup(hid_t group, const std::string& prefix) {
    H5O_info_t object = {};
    if (H5Oget_info(group, &object) < 0) Fail(path_, "damaged group " + prefix);
    if (!seen_.insert(object.addr).second) return Note(prefix + " is a link, left out");
    H5G_info_t info = {};
    if (H5Gget_info(group, &info) < 0) Fail(path_, "damaged group " + prefix);
    // In the order of writing where the file knows it, else by name.
    const Handle plist(H5Gget_create_plist(group), H5Pclose);
    unsigned order = 0;
    H5Pget_link_creation_order(plist, &order);
    const bool indexed = (order & H5P_CRT_ORDER_INDEXED) != 0;
    const H5_index_t index = indexed ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
    for (hsize_t k = 0; k < info.nlinks; ++k) ReadLink(group, index, k, prefix);
  }

  void ReadAttributes(hid_t file) {
    const auto visit = [](hid_t at, const char* name, const H5A_info_t*, void* self) -> herr_t {
      const std::optional<std::string> text = ReadTextAttribute(at, name);
      if (text) static_cast<Hdf5Traversal*>(self)->record_.attributes[name] = *text;
      return 0;
    };
    H5Aiterate2(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, this);
  }

 private:
  void ReadLink(hid_t group, H5_index_t index, hsize_t k, const std::string& prefix) {
    H5L_info_t link = {};
    if (H5Lget_info_by_idx(group, ".", index, H5_ITER_INC, k, &link, H5P_DEFAULT) < 0)
      Fail(path_, "damaged link in group " + prefix);
    const ssize_t length =
        H5Lget_name_by_idx(group, ".", index, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT);
    if (length < 0) Fail(path_, "damaged link in group " + prefix);
    std::string name(static_cast<std::size_t>(length) + 1, '\0');
    H5Lget_name_by_idx(group, ".", index, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
    name.pop_back();
    const std::string full = prefix.empty() ? name : prefix + '.' + name;
    if (link.type != H5L_TYPE_HARD) return Note(full + " is a link, left out");
    const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object.usable()) Fail(path_, "damaged object " + full);
    if (H5Iget_type(object) == H5I_DATASET) return ReadDataset(object, full);
    if (H5Iget_type(object) != H5I_GROUP) return;
    ReadGroup(object, full);
  }

  void ReadDataset(hid_t dataset, const std::string& name) {
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    const std::optional<hsize_t> rows = VectorRows(dataset);
    const bool number = kind == H5T_FLOAT || kind == H5T_INTEGER;
    if (number && (name == "rate" || name == "start") && IsSingle(dataset)) {
      double* to = name == "rate" ? &record_.rate : &record_.start;
      if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) < 0)
        Fail(path_, name + " cannot be read");
      return;
    }
    if (!number || !rows) return Note(name + " is not a vector of numbers, left out");
    if (RefersElsewhere(dataset)) return Note(name + " is stored in another file, left out");
    if (*rows > kMaxRows) throw InputError(path_ + ": channel " + name + " has too many rows");
    Channel channel{name, ReadTextAttribute(dataset, "unit").value_or(""),
                    std::vector<double>(*rows)};
    if (*rows > 0 && H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                             channel.samples.data()) < 0)
      Fail(path_, "channel " + name + " cannot be read");
    record_.channels.push_back(std::move(channel));
  }

  void Note(const std::string& text) { record_.notes.push_back(path_ + ": " + text); }

  const std::string& path_;
  Record& record_;
  std::set<haddr_t> seen_;  // groups: hard links may form a ring
};

Handle OpenForReading(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(path + ": no such file");
  if (!std::filesystem::is_regular_file(status)) throw InputError(path + ": not a file");
  const htri_t is_hdf5 = H5Fis_hdf5(path.c_str());
  if (is_hdf5 == 0) throw InputError(path + ": not an HDF5 file");
  Handle file(is_hdf5 < 0 ? -1 : H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.usable()) Fail(path, "cannot be opened as HDF5");
  return file;
}

Record ReadGroup(const std::string& path, const std::string& name) {
  Record record;
  const Handle file = OpenForReading(path);
  if (name != "/" && H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0)
    throw InputError(path + ": no group " + name);
  const Handle group(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose);
  if (!group.usable()) Fail(path, name == "/" ? "damaged root group" : "damaged group " + name);
  record.rate = ReadNumber(group, "rate").value_or(0);
  record.start = ReadNumber(group, "start").value_or(0);
  Hdf5Traversal reader(path, record);
  reader.ReadAttributes(group);
  reader.ReadGroup(group, "");
  return record;
}

/// Whether something in the root group of the file carries this attribute.
bool SomeObjectCarries(const std::string& path, const std::string& attribute) {
  const Handle file = OpenForReading(path), root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose);
  H5G_info_t info = {};
  if (!root.usable() || H5Gget_info(root, &info) < 0) Fail(path, "damaged root group");
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    const Handle object(H5Oopen_by_idx(root, ".", H5_INDEX_NAME, H5_ITER_INC, k, H5P_DEFAULT),
                        H5Oclose);
    if (object.usable() && H5Aexists(object, attribute.c_str()) > 0) return true;
  }
  return false;
}

}  // namespace

void RefuseWhatCrashesHdf5(const std::string& path, const std::function<void()>& read) {
  if (!SurvivesInACopy(read))
    throw InputError(path + ": damaged, HDF5 crashes or does not end when it reads it");
}

std::mutex& Hdf5Mutex() {
  static std::mutex mutex;
  return mutex;
}

bool HasObjectWith(const std::string& attribute, const std::string& path) {
  const Library library;
  const auto look = [&] { return SomeObjectCarries(path, attribute); };
  RefuseWhatCrashesHdf5(path, look);
  return look();
}

Record ReadHdf5(const std::string& path) { return ReadHdf5Group(path, "/"); }

Record ReadHdf5Group(const std::string& path, const std::string& name) try {
  Record record;
  {
    const Library library;
    const auto read = [&] { return ReadGroup(path, name); };
    RefuseWhatCrashesHdf5(path, read);
    record = read();
  }
  FinishRecord(record, path);
  return record;
} catch (const std::bad_alloc&) {
  throw InputError(path + ": too large for the memory of this machine");
}

}  // namespace ambrig
