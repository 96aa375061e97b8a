#pragma once
/// The journal of a long work: a header that names the work, then one entry for every part that is
/// finished. An entry is handed to the system before Append returns, so that kill -9 loses none; an
/// entry that was cut off or changed (full disk, power) is found by its check sum and left out.
///
///   TEXT <tab> CHECK                      the header and entries of one line, CHECK: 16 hex digits
///   TEXT <tab> CHECK+BYTES <newline> DATA entries with binary data behind the line
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "core/base/append_file.h"

namespace ambrig {

struct JournalEntry {
  std::string_view text;              // one line; valid during the visit only
  std::size_t line = 0;               // of the file, where it is text [-]
  std::size_t offset = 0, bytes = 0;  // of the data in the file
};

/// What is done with a journal that is read: `header` throws an InputError when the journal is of
/// another work; `entry` returns false for an entry that says nothing to this work.
struct JournalVisitor {
  std::function<void(std::string_view text)> header;
  std::function<bool(const JournalEntry&)> entry;
};

/// Reads a journal without taking it. An empty header is visited when there is not a whole one.
/// @return entries that were damaged or said nothing. @throws InputError when there is no file
std::size_t ReadJournalFile(const std::string& path, const JournalVisitor& visit);

class Journal {
 public:
  /// Begins the file (and its folder) with `header`, or reads what is there and continues it.
  /// @throws InputError when it is of another work, in use, or cannot be written.
  Journal(const std::string& path, const std::string& header, const JournalVisitor& visit);

  const std::string& path() const { return file_.path(); }
  std::size_t damaged() const { return damaged_; }
  /// Thread-safe; `text` without newline. Returns the offset of the data. @throws InputError (full
  /// disk ...)
  std::size_t Append(std::string_view text, std::string_view data = {});
  /// Data of an entry; false when they are not there. Thread-safe.
  bool ReadData(std::size_t offset, char* out, std::size_t bytes) const {
    return file_.ReadAt(offset, out, bytes);
  }

 private:
  AppendFile file_;
  std::mutex mutex_;
  std::size_t end_ = 0;  // bytes
  std::size_t damaged_ = 0;
};

}  // namespace ambrig
