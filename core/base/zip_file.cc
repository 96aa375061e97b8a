#include "core/base/zip_file.h"

#include <fmt/format.h>
#include <zip.h>

#include <filesystem>
#include <memory>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

constexpr zip_uint64_t kMostUnpacked = 1ULL << 30;
constexpr std::size_t kStored = 128;  // [bytes] shorter ones are readable as they are

std::string ReasonOf(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

struct Discard {
  void operator()(zip_t* zip) const { zip_discard(zip); }
};
struct CloseFile {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

/// Where an entry goes. @throws InputError when that is outside of the folder
std::filesystem::path PlaceOf(const std::string& archive, const std::string& name,
                              const std::filesystem::path& folder) {
  const std::filesystem::path inside = std::filesystem::path(name).lexically_normal();
  if (name.empty() || inside.is_absolute() || *inside.begin() == "..")
    throw InputError(fmt::format("{}: the entry \"{}\" leads out of the archive", archive, name));
  return folder / inside;
}

std::string ReadEntry(const std::string& archive, zip_t* zip, zip_uint64_t index,
                      zip_uint64_t size) {
  const std::unique_ptr<zip_file_t, CloseFile> file(zip_fopen_index(zip, index, 0));
  std::string bytes(size, '\0');
  if (!file || zip_fread(file.get(), bytes.data(), size) != static_cast<zip_int64_t>(size))
    throw InputError(fmt::format("{}: {} cannot be unpacked: {}", archive,
                                 zip_get_name(zip, index, 0), zip_strerror(zip)));
  return bytes;
}

}  // namespace

void WriteZip(const std::string& path, const std::vector<ZipEntry>& entries) {
  AtomicFile file(path);
  int code = 0;
  std::unique_ptr<zip_t, Discard> zip(
      zip_open(file.temporary().c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (!zip) throw InputError(fmt::format("cannot write {}: {}", path, ReasonOf(code)));
  for (const auto& [name, bytes] : entries) {
    zip_source_t* source = zip_source_buffer(zip.get(), bytes.data(), bytes.size(), 0);
    const zip_int64_t index =
        source ? zip_file_add(zip.get(), name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
      if (source) zip_source_free(source);
      throw InputError(fmt::format("cannot write {}: {}", path, zip_strerror(zip.get())));
    }
    if (bytes.size() < kStored)
      zip_set_file_compression(zip.get(), static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
    zip_file_set_dostime(zip.get(), static_cast<zip_uint64_t>(index), 0, (1 << 5) | 1,
                         0);  // 1980-01-01
  }
  if (zip_close(zip.get()) != 0)
    throw InputError(fmt::format("cannot write {}: {}", path, zip_strerror(zip.get())));
  zip.release();  // closed
  file.Commit();
}

void UnpackZip(const std::string& path, const std::string& folder) {
  int code = 0;
  const std::unique_ptr<zip_t, Discard> zip(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!zip) throw InputError(fmt::format("{}: cannot be unpacked: {}", path, ReasonOf(code)));
  zip_uint64_t total = 0;
  const zip_int64_t count = zip_get_num_entries(zip.get(), 0);
  for (zip_int64_t k = 0; k < count; ++k) {
    const auto index = static_cast<zip_uint64_t>(k);
    zip_stat_t stat;
    if (zip_stat_index(zip.get(), index, 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE))
      throw InputError(fmt::format("{}: entry {} cannot be read", path, k + 1));
    total += stat.size;
    if (stat.size > kMostUnpacked || total > kMostUnpacked)
      throw InputError(fmt::format("{}: unpacks to more than 1 GiB", path));
    const std::filesystem::path place = PlaceOf(path, stat.name, folder);
    if (std::string(stat.name).ends_with('/')) {
      std::filesystem::create_directories(place);
      continue;
    }
    std::filesystem::create_directories(place.parent_path());
    WriteFileAtomically(place.string(), ReadEntry(path, zip.get(), index, stat.size));
  }
}

}  // namespace ambrig
