#include <algorithm>
#include <functional>

#include "core/base/atomic_file.h"
#include "core/record/hdf5_deflate_gain.h"
#include "core/record/hdf5_library.h"
#include "core/record/time_base.h"

namespace ambrig {
namespace {

using namespace hdf5;

constexpr hsize_t kChunkRows = 1 << 14;
constexpr unsigned kDeflateLevel = 1;  // higher ones gain next to nothing of noisy readings

/// Every call of the library goes through here; what fails here is lack of memory, not the disk.
template <class Result>
Result Check(Result result, const std::string& path, const std::string& what) {
  if (result < 0) Fail("cannot write " + path, what);
  return result;
}

class Writer {
 public:
  explicit Writer(const std::string& path) : path_(path) {}

  /// In memory, so that no full disk can interrupt the library half-way.
  std::string Image(const std::function<void(hid_t file)>& write) const {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    Check(H5Pset_fapl_core(access, 1 << 20, 0), path_, "memory file");
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    Check(H5Pset_obj_track_times(creation, 0), path_, "no times");
    // Brings newer object headers, whose attributes may exceed 64 kB: the parameters of a whole
    // rig. (The newer superblock would too, but HDF5 1.10 returns its image with a wrong checksum.)
    Check(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED), path_, "attribute order");
    Check(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
          path_, "order");
    const Handle file(H5Fcreate("record", H5F_ACC_TRUNC, creation, access), H5Fclose);
    Check(hid_t{file}, path_, "no file");
    write(file);
    Check(H5Fflush(file, H5F_SCOPE_GLOBAL), path_, "flush");
    std::string bytes(
        static_cast<std::size_t>(Check(H5Fget_file_image(file, nullptr, 0), path_, "size")), '\0');
    Check(H5Fget_file_image(file, bytes.data(), bytes.size()), path_, "image");
    return bytes;
  }

  void WriteRecord(hid_t at, const Record& record) const {
    for (const Channel& c : record.channels) WriteChannel(at, c);
    WriteNumber(at, "rate", record.rate);
    WriteNumber(at, "start", record.start);
    for (const auto& [name, text] : record.attributes) WriteText(at, name, text);
  }

  void WriteGroup(hid_t file, const std::string& name, const Record& record) const {
    const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    Check(H5Pset_obj_track_times(creation, 0), path_, "no times");
    Check(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
          path_, "order");
    Check(H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED), path_, "attribute order");
    const Handle group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT),
                       H5Gclose);
    Check(hid_t{group}, path_, "group " + name);
    WriteRecord(group, record);
  }

  void WriteText(hid_t object, const std::string& name, const std::string& text) const {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose), type(H5Tcopy(H5T_C_S1), H5Tclose);
    Check(H5Tset_size(type, text.size() + 1), path_, name);
    Check(H5Tset_cset(type, H5T_CSET_UTF8), path_, name);
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    Check(hid_t{attribute}, path_, "attribute " + name);
    Check(H5Awrite(attribute, type, text.c_str()), path_, "attribute " + name);
  }

 private:
  void WriteChannel(hid_t file, const Channel& c) const {
    const hsize_t rows = c.samples.size();
    const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    Check(H5Pset_obj_track_times(creation, 0), path_, "no times");
    if (rows > 0 && DeflatePays(c.samples)) {
      const hsize_t chunk = std::min(rows, kChunkRows);
      Check(H5Pset_chunk(creation, 1, &chunk), path_, "chunks");
      Check(H5Pset_shuffle(creation), path_, "shuffle");
      Check(H5Pset_deflate(creation, kDeflateLevel), path_, "deflate");
    }
    const Handle dataset(
        H5Dcreate2(file, c.name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT),
        H5Dclose);
    Check(hid_t{dataset}, path_, "channel " + c.name);
    if (rows > 0)
      Check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, c.samples.data()),
            path_, "channel " + c.name);
    WriteText(dataset, "unit", c.unit);
  }

  void WriteNumber(hid_t object, const char* name, double value) const {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(
        H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    Check(hid_t{attribute}, path_, name);
    Check(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), path_, name);
  }

  const std::string& path_;
};

/// A slash would make groups, which reading turns into dots: another name than was written.
void CheckWritable(const Record& record, const std::string& where) {
  for (const Channel& c : record.channels)
    if (c.name.empty() || c.name == "." || c.name.find('/') != std::string::npos)
      throw InputError(where + ": channel name '" + c.name + "'");
  CheckRecord(record, where);
}

}  // namespace

void WriteHdf5(const Record& record, const std::string& path) {
  CheckWritable(record, "cannot write " + path);
  std::string image;
  {
    const Library library;
    const Writer writer(path);
    image = writer.Image([&](hid_t file) { writer.WriteRecord(file, record); });
  }
  WriteFileAtomically(path, image);
}

void WriteHdf5Groups(const std::vector<std::pair<std::string, Record>>& records,
                     const std::map<std::string, std::string>& attributes,
                     const std::string& path) {
  for (const auto& [name, record] : records) {
    if (name.empty() || name.find_first_of("/.") != std::string::npos)
      throw InputError("cannot write " + path + ": group name '" + name + "'");
    CheckWritable(record, "cannot write " + path);
  }
  std::string image;
  {
    const Library library;
    const Writer writer(path);
    image = writer.Image([&](hid_t file) {
      for (const auto& [name, record] : records) writer.WriteGroup(file, name, record);
      for (const auto& [name, text] : attributes) writer.WriteText(file, name, text);
    });
  }
  WriteFileAtomically(path, image);
}

}  // namespace ambrig
