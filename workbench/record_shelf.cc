#include "workbench/record_shelf.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "core/base/errors.h"
#include "core/record/hdf5.h"
#include "core/record/read_record.h"

namespace ambrig::workbench {
namespace {

constexpr std::size_t kMostRecords = 12;

std::size_t BytesOf(const KeptRecord& r) { return r.rows * r.channels.size() * sizeof(float); }

KeptRecord InSinglePrecision(std::string key, Record record) {
  KeptRecord out{
      .key = std::move(key), .rate = record.rate, .start = record.start, .rows = record.rows()};
  out.notes = std::move(record.notes);
  for (Channel& c : record.channels) {
    out.channels.push_back({c.name, c.unit, {c.samples.begin(), c.samples.end()}});
    c.samples = {};  // a record may be as large as half the memory
  }
  return out;
}

}  // namespace

KeptChannel* KeptRecord::Find(std::string_view name) {
  const auto found = std::ranges::find(channels, name, &KeptChannel::name);
  return found == channels.end() ? nullptr : &*found;
}

/// Drops the records that were looked at longest ago, the first one never.
void RecordShelf::MakeRoom() {
  std::size_t bytes = 0, count = 0;
  auto keep = kept_.begin();
  for (; keep != kept_.end() && count < kMostRecords; ++keep, ++count) {
    bytes += BytesOf(*keep);
    if (count > 0 && bytes > most_bytes_) break;
  }
  kept_.erase(keep, kept_.end());
}

KeptRecord& RecordShelf::Get(const std::string& file, const std::string& group) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) throw InputError(file + ": " + std::strerror(errno));
  const std::string key =
      fmt::format("{}|{}|{}|{}|{}.{}", file, group, status.st_ino, status.st_size,
                  status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
  const auto known = std::ranges::find(kept_, key, &KeptRecord::key);
  if (known != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, known);
    return kept_.front();
  }
  const auto read = [&] {
    return InSinglePrecision(key, group.empty() ? ReadRecord(file) : ReadHdf5Group(file, group));
  };
  try {
    kept_.push_front(read());
  } catch (const std::bad_alloc&) {
    kept_.clear();  // there may be room for this one alone
    kept_.push_front(read());
  }
  MakeRoom();
  ::malloc_trim(0);  // what reading took goes back
  return kept_.front();
}

}  // namespace ambrig::workbench
