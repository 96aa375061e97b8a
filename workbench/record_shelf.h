#pragma once
/// Records in memory for the page, in single precision, which is what the page is sent.
#include <cstddef>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "workbench/extremes.h"

namespace ambrig::workbench {

struct KeptChannel {
  std::string name, unit;
  std::vector<float> samples;
  std::optional<ExtremesLevel> level = {};  // made when it is first drawn
};

struct KeptRecord {
  std::string key;   // file, group and version
  double rate = 0;   // [Hz]
  double start = 0;  // [s]
  std::size_t rows = 0;
  std::vector<KeptChannel> channels = {};
  std::vector<std::string> notes = {};

  /// nullptr when absent.
  KeptChannel* Find(std::string_view name);
};

/// The records that were looked at last: at most so many bytes of samples, or one record however
/// large.
class RecordShelf {
 public:
  explicit RecordShelf(std::size_t most_bytes = 200 << 20) : most_bytes_(most_bytes) {}
  /// @throws InputError when the file cannot be read; std::bad_alloc when it needs more memory than
  /// there is
  KeptRecord& Get(const std::string& file, const std::string& group);
  std::size_t count() const { return kept_.size(); }

 private:
  void MakeRoom();

  std::size_t most_bytes_;
  std::list<KeptRecord> kept_;
};

}  // namespace ambrig::workbench
